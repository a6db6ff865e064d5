/** Furry models for the figures. */

import { type Object3D, Vector3 } from 'three';
import { type GLTF, GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { type Fur, FurLoaderPlugin } from '../../fur/index.ts';
import type { Lesson } from '../lesson.ts';

/** Long fur in the article's own form: colours, and no mean curves. `pelt-short` is the same, short. */
export const ARTICLE_FORM = 'torus-512-colour';

export interface Furry {
	object: Object3D;
	fur: Fur;
}

/**
 * Loads a model of `models/`, a new one for each caller.
 *
 * @throws Error that says what is wrong
 */
export async function loadFurry(name: string, { painter }: Lesson): Promise<Furry> {
	const loader = new GLTFLoader();
	const { limits } = painter;
	loader.register((parser) => new FurLoaderPlugin(parser, limits ? { limits } : {}));
	const gltf: GLTF = await loader.loadAsync(new URL(`models/${name}/model.gltf`, document.baseURI).href);
	const fur: Fur | undefined = gltf.userData.fur;
	if (!fur) throw new Error(`models/${name}: got a model without fur`);
	Object.assign(fur.shells.material, { gloss: 0.25, backlight: 40 });
	return { object: gltf.scene, fur };
}

/** Loads the report of `furbake bake` on a model. */
export async function loadReport<T>(name: string): Promise<T> {
	const response = await fetch(`models/${name}/bake.json`);
	if (!response.ok) throw new Error(`models/${name}/bake.json: got status ${response.status}`);
	return response.json();
}

/** Centre and radius of a furry body. */
export function reach({ fur }: Furry): { centre: Vector3; radius: number } {
	const sphere = fur.shells.geometry.boundingSphere;
	if (!sphere) return { centre: new Vector3(), radius: 1 };
	const { position, quaternion, scale } = fur.shells;
	const centre = sphere.center.clone().multiply(scale).applyQuaternion(quaternion).add(position);
	return { centre, radius: sphere.radius * scale.x };
}
