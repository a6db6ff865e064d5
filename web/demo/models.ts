/** From a name or a path in the address to a model in memory. */

import { Box3, type LoadingManager, Mesh, type Object3D, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { type Fur, FurLoaderPlugin, type TextureLimits } from '../fur/index.ts';
import { disposeAll } from '../page/dispose.ts';
import { parseAddress, type Triple } from './address.ts';

/** From the side: light from the front is flat. */
export const defaultLight: Triple = [-0.82, 0.57, -0.02];
const defaultCamera: Triple = [0, 8, 1];
const crowdCamera: Triple = [10, 13, 0.5];

/** An entry of models/models.json. */
export interface MenuEntry {
	name: string;
	title: string;
	/** of a model: what it is furry with */
	preset?: string;
	/** of a pelt, which other models are dressed in: the preset that it is, and what its light curves are */
	pelt?: string;
	basis?: 'ptm' | 'eigen';
	/** of a pelt: whether its planes are the preset's own, finer than those of models that wear it */
	fine?: boolean;
	/** of a pelt: strength of the highlights that suits it, where it is not that of all others */
	gloss?: number;
	/** of a pelt: how far a model's own second tip colour shows on it, 0..1 */
	tips?: number;
	/** false: shown only where the address asks for it */
	menu?: boolean;
	/** first view and light, written as in the address */
	view?: string;
	/** of the command that bakes it: they tell which states a pelt has */
	options?: string[];
}

/** Where a model's files come from. */
export interface Source {
	/** of the glTF file; the files that it names are sought beside it */
	url: string;
	/** what all of them are loaded with: it may lead their addresses elsewhere, and counts what has come */
	manager?: LoadingManager | undefined;
}

export interface ModelOptions {
	/**
	 * Called with the model as soon as its skin can be shown; the same model has `fur` once it is loaded. Where loading fails
	 * later, it is the caller's to take away.
	 */
	skin?: (model: Model) => void;
}

/** A model that is ready to be shown. */
export interface Model {
	object: Object3D;
	/** undefined where the file has none that this page can grow */
	fur: Fur | undefined;
	/** the version of its fur, where that is newer than what this page knows */
	newer?: string;
	/** box around the skin */
	box: Box3;
	/** of the sphere around the box's centre that holds the skin */
	radius: number;
	dispose(): void;
}

/** All models that have a name, those that no menu offers too. */
export async function loadMenu(): Promise<MenuEntry[]> {
	const response = await fetch('models/models.json');
	if (!response.ok) throw new Error(`models/models.json: got status ${response.status}, expected the list of models`);
	return response.json();
}

/** What the menu lists. */
export function offered(entries: readonly MenuEntry[]): MenuEntry[] {
	return entries.filter(({ menu }) => menu !== false);
}

/** What models can be dressed in, in the paper's basis or in the light curves found for that very fur. */
export function pelts(entries: readonly MenuEntry[], basis: 'ptm' | 'eigen' = 'ptm'): MenuEntry[] {
	return entries.filter((entry) => entry.pelt !== undefined && entry.basis === basis && !entry.fine);
}

/** How a model of the menu wants to be seen first, or all of a crowd. */
export function firstView(entry: MenuEntry | undefined, crowd = 1): { light: Triple; camera: Triple } {
	const { light = defaultLight, camera = defaultCamera } = parseAddress(entry?.view ?? '').view;
	return { light, camera: crowd > 1 ? crowdCamera : camera };
}

/**
 * @param model a name of the menu, or a path or http address of a folder (or of the glTF file in it)
 * @returns the folder with a slash at its end; undefined where there can be none
 */
export function folderOf(model: string, menu: readonly MenuEntry[], base: string): URL | undefined {
	const named = menu.some(({ name }) => name === model);
	if (!named && !/[./:]/.test(model)) return undefined;
	const path = named ? `models/${model}` : model.replace(/\/?(model\.gltf)?$/, '');
	if (!URL.canParse(`${path}/`, base)) return undefined;
	const url = new URL(`${path}/`, base);
	return /^https?:$/.test(url.protocol) ? url : undefined;
}

/** The files in a folder of some server. @param folder as of `folderOf` */
export function sourceAt(folder: URL, manager?: LoadingManager): Source {
	return { url: new URL('model.gltf', folder).href, manager };
}

/**
 * @param limits of the GPU that is to show it
 * @throws Error that names the file and says what is wrong with it
 */
export async function loadModel(
	{ url, manager }: Source,
	limits: TextureLimits,
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
	const gltf = await loader.loadAsync(url).catch((error: unknown) => {
		throw new Error(reason(error));
	});
	model ??= modelOf(gltf.scene);
	model.fur = gltf.userData.fur;
	if (newer) model.newer = newer;
	return model;
}

/** A pelt for `dress`, of the caller's to dispose of. @throws Error as `loadModel` */
export async function loadPelt(source: Source, limits: TextureLimits): Promise<Fur> {
	const { fur } = await loadModel(source, limits);
	if (!fur) throw new Error('model.gltf: got a model without fur, expected a pelt');
	return fur;
}

/** A model whose fur has not grown yet. */
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

function reason(error: unknown): string {
	const text = error instanceof Error ? error.message : String(error);
	if (error instanceof SyntaxError) return `model.gltf: expected glTF, but it is not even JSON (${text})`;
	// The words of three's loader: it names the address and the status.
	const missing = /^fetch for "([^"]*)" responded with 404/.exec(text);
	return missing ? `${missing[1]?.split('/').at(-1)}: there is no such file` : text;
}

/** A box's own sphere is up to 1.7 times too large for a round body: this one goes through the farthest vertex. */
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
