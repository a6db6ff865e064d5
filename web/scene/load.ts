/** Files of a model → the model in memory. */

import { type AnimationClip, Box3, type LoadingManager, Mesh, type Object3D, SkinnedMesh, Vector3 } from 'three';
import { type GLTF, GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { type Fur, type FurLimits, FurLoaderPlugin, keepThinFurParts } from '../fur/index.ts';
import { disposeAll } from '../page/dispose.ts';
import type { ClipPlayer } from './clips/ClipPlayer.ts';
import type { Room } from './clips/Reach.ts';
import { gleam } from './gleam.ts';
import { features, type Model } from './model.ts';

/** Source of a model's files. */
export interface Source {
	/** address of the glTF file; the files that it names are sought beside it */
	url: string;
	/** loads all of them: it may lead their addresses elsewhere, and counts what has come */
	manager?: LoadingManager | undefined;
	/** Whether furbake is known to have written it: it is shown unchecked then, and the checks tell what fails none the less. */
	sound?: boolean;
}

export interface ModelOptions {
	/**
	 * Called with the model as soon as its skin can be shown; it has `fur` at the end. The caller removes it if loading fails
	 * later.
	 */
	skin?: (model: Model) => void;
}

/** Source of a folder on a server. @param folder as of `folderOf` */
export function sourceAt(folder: URL, sound: boolean, manager?: LoadingManager): Source {
	return { url: new URL('model.gltf', folder).href, manager, sound };
}

/**
 * @param limits of the GPU
 * @throws Error that names the file and says what is wrong with it
 */
export async function loadModel(
	{ url, manager, sound = false }: Source,
	limits: FurLimits,
	{ skin }: ModelOptions = {},
): Promise<Model> {
	let model: Promise<Model> | undefined;
	let newer: string | undefined;
	let check = !sound;
	const loader = new GLTFLoader(manager);
	let clips: readonly AnimationClip[] = [];
	loader.register((parser) => {
		if (parser.json.animations?.length) void importPlayer();
		return {
			name: 'clips',
			async afterRoot({ animations }: GLTF) {
				clips = animations;
			},
		};
	});
	// Second: it shows the skin in the pose of a clip.
	loader.register((parser) => {
		const early = (scene: Object3D) => {
			model = modelOf(scene, clips);
			model.then(skin).catch(() => {}); // awaited below
		};
		return new FurLoaderPlugin(parser, {
			limits,
			check,
			skin: early,
			newer: (version) => {
				newer = version;
			},
		});
	});
	// Beside the file, not after it.
	if (check) void fetchChecks();
	const load = async () => {
		const gltf = await loader.loadAsync(url);
		const whole = await (model ?? modelOf(gltf.scene, clips));
		return Object.assign(whole, { fur: gltf.userData.fur });
	};
	const whole = await load()
		.catch((error: unknown) => {
			if (check && !isBrokenOff(error)) throw error;
			check = true;
			return load();
		})
		.catch((error: unknown) => {
			throw new Error(reason(error));
		});
	if (whole.fur) {
		const parts = features(whole.object, whole.fur);
		gleam(parts);
		keepThinFurParts(whole.object, parts);
	}
	if (newer) whole.newer = newer;
	return whole;
}

/** Loads a pelt for `dressFur`; the caller disposes of it. @throws Error as `loadModel` */
export async function loadPelt(source: Source, limits: FurLimits): Promise<Fur> {
	const { fur } = await loadModel(source, limits);
	if (!fur) throw new Error('model.gltf: got a model without fur, expected a pelt');
	return fur;
}

/** Fetches the checks of models of unknown origin; loading tells where they do not come. */
export const fetchChecks = (): Promise<unknown> => import('../fur/checks.ts').catch(() => undefined);

const importPlayer = () => Promise.all([import('./clips/ClipPlayer.ts'), import('./clips/Gaze.ts')]);

async function player(
	...[object, meshes, clips, rest]: [Object3D, Mesh[], AnimationClip[], Room]
): Promise<ClipPlayer> {
	const [{ ClipPlayer }, { Gaze }] = await importPlayer();
	return new ClipPlayer(object, meshes, clips, rest, Gaze.of(object));
}

/** Makes a model without its fur, which is not in the scene yet. @param object undefined for a file without a scene */
async function modelOf(object: Object3D | undefined, animations: readonly AnimationClip[]): Promise<Model> {
	const meshes: Mesh[] = [];
	object?.traverse((child) => {
		if (child instanceof Mesh && child.geometry.getAttribute('position')?.count > 0) meshes.push(child);
	});
	if (!object || meshes.length === 0) throw new Error('model.gltf: got a scene without a mesh, expected one');
	object.updateMatrixWorld(true);
	// Bones carry a mesh out of the sphere that three culls it by.
	for (const mesh of meshes) if (mesh instanceof SkinnedMesh) mesh.frustumCulled = false;
	const moving = animations.filter(({ tracks }) => tracks.length > 0);
	const rest = new Box3().setFromObject(object);
	const radius = radiusAround(meshes, rest.getCenter(new Vector3()));
	const clips = moving.length > 0 ? await player(object, meshes, moving, { box: rest, radius }) : undefined;
	const box = clips?.box ?? rest;
	const model: Model = {
		...{ object, box, fur: undefined },
		...(clips && { clips }),
		get radius() {
			return clips?.radius ?? radius;
		},
		dispose() {
			this.clips?.dispose();
			this.fur?.dispose();
			disposeAll(object);
		},
	};
	return model;
}

/** True for a model.gltf that may arrive whole at a second try; other files have had theirs. */
function isBrokenOff(error: unknown): boolean {
	const { name, response } = error as Error & { response?: Response };
	return name === 'TypeError' || name === 'SyntaxError' || (response?.status ?? 0) >= 500;
}

/** What Chromium, Firefox and Safari say of a request that got no answer. */
const UNREACHED = /failed to fetch|network ?error|load failed/i;

function reason(error: unknown): string {
	const text = error instanceof Error ? error.message : String(error);
	if (error instanceof SyntaxError) return `model.gltf: expected glTF, but it is not even JSON (${text})`;
	if (error instanceof TypeError && UNREACHED.test(text))
		return `files do not arrive: there is no connection, or their host does not let this page read them (${text})`;
	// Message of three's loader, with address and status.
	const missing = /^fetch for "([^"]*)" responded with 404/.exec(text);
	return missing ? `${missing[1]?.split('/').at(-1)}: there is no such file` : text;
}

/** Radius to the farthest vertex: a box's own sphere is up to 1.7 times too large for a round body. */
function radiusAround(meshes: readonly Mesh[], centre: Vector3): number {
	const vertex = new Vector3();
	let radius = 0;
	for (const mesh of meshes) {
		for (let i = 0; i < mesh.geometry.getAttribute('position').count; i++) {
			mesh.getVertexPosition(i, vertex).applyMatrix4(mesh.matrixWorld);
			radius = Math.max(radius, vertex.distanceTo(centre));
		}
	}
	return radius;
}
