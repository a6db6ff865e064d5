/** Files of a model → the model in memory. */

import { Box3, type LoadingManager, Mesh, type Object3D, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { type Fur, type FurLimits, FurLoaderPlugin } from '../../fur/index.ts';
import { disposeAll } from '../../page/dispose.ts';
import type { Source } from '../open/files.ts';
import type { Model } from '../stage/model.ts';

export interface ModelOptions {
	/**
	 * Called with the model as soon as its skin can be shown; it has `fur` at the end. The caller removes it if loading fails
	 * later.
	 */
	skin?: (model: Model) => void;
}

/** Source of a folder on a server. @param folder as of `folderOf` */
export function sourceAt(folder: URL, manager?: LoadingManager): Source {
	return { url: new URL('model.gltf', folder).href, manager };
}

/**
 * @param limits of the GPU
 * @throws Error that names the file and says what is wrong with it
 */
export async function loadModel(
	{ url, manager }: Source,
	limits: FurLimits,
	{ skin }: ModelOptions = {},
): Promise<Model> {
	let model: Model | undefined;
	let newer: string | undefined;
	const loader = new GLTFLoader(manager);
	loader.register((parser) => {
		const early = (scene: Object3D) => {
			if (!skin) return;
			model = modelOf(scene);
			skin(model);
		};
		return new FurLoaderPlugin(parser, {
			limits,
			skin: early,
			newer: (version) => {
				newer = version;
			},
		});
	});
	const load = () => loader.loadAsync(url);
	const gltf = await load()
		.catch((error: unknown) => (isBrokenOff(error) ? load() : Promise.reject(error)))
		.catch((error: unknown) => {
			throw new Error(reason(error));
		});
	model ??= modelOf(gltf.scene);
	model.fur = gltf.userData.fur;
	if (newer) model.newer = newer;
	return model;
}

/** Loads a pelt for `dressFur`; the caller disposes of it. @throws Error as `loadModel` */
export async function loadPelt(source: Source, limits: FurLimits): Promise<Fur> {
	const { fur } = await loadModel(source, limits);
	if (!fur) throw new Error('model.gltf: got a model without fur, expected a pelt');
	return fur;
}

/** Makes a model without its fur. */
function modelOf(object: Object3D): Model {
	const box = new Box3().setFromObject(object);
	if (box.isEmpty()) throw new Error('model.gltf: got a scene without a mesh, expected one');
	return {
		object,
		fur: undefined,
		box,
		radius: radiusAround(object, box.getCenter(new Vector3())),
		dispose() {
			this.fur?.dispose();
			disposeAll(object);
		},
	};
}

/** True for a model.gltf that may arrive whole at a second try; other files have had theirs. */
function isBrokenOff(error: unknown): boolean {
	const { name, response } = error as Error & { response?: Response };
	return name === 'TypeError' || name === 'SyntaxError' || (response?.status ?? 0) >= 500;
}

function reason(error: unknown): string {
	const text = error instanceof Error ? error.message : String(error);
	if (error instanceof SyntaxError) return `model.gltf: expected glTF, but it is not even JSON (${text})`;
	// Message of three's loader, with address and status.
	const missing = /^fetch for "([^"]*)" responded with 404/.exec(text);
	return missing ? `${missing[1]?.split('/').at(-1)}: there is no such file` : text;
}

/** Radius to the farthest vertex: a box's own sphere is up to 1.7 times too large for a round body. */
function radiusAround(object: Object3D, centre: Vector3): number {
	const vertex = new Vector3();
	let radius = 0;
	object.updateMatrixWorld(true);
	object.traverse((child) => {
		if (!(child instanceof Mesh)) return;
		const position = child.geometry.getAttribute('position');
		for (let i = 0; i < position.count; i++) {
			vertex.fromBufferAttribute(position, i).applyMatrix4(child.matrixWorld);
			radius = Math.max(radius, vertex.distanceTo(centre));
		}
	});
	return radius;
}
