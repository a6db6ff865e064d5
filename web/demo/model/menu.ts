/** The list of models and pelts: `models/models.json`. */

import { MathUtils, Object3D, Vector3 } from 'three';
import { DEFAULT_CAMERA, DEFAULT_LIGHT } from '../../page/light.ts';
import { parseAddress } from '../state/address.ts';
import type { Triple } from '../state/view.ts';

const CROWD_CAMERA: Triple = [10, 13, 0.5];

/** An entry of the list: a model, or a pelt that models can be dressed in. */
export interface MenuEntry {
	name: string;
	title: string;
	/** preset of a model's own fur */
	preset?: string;
	/** preset of a pelt */
	pelt?: string;
	/** light curves of a pelt */
	basis?: 'ptm' | 'eigen';
	/** true for a pelt in the preset's own planes, which are finer than those of its models */
	fine?: boolean;
	/** states of a pelt beside dry and clean */
	wet?: boolean;
	dirt?: boolean;
	/** strength of the highlights, where it is not the usual one */
	gloss?: number;
	/** share of a model's own second tip colour on a pelt, 0..1 */
	tips?: number;
	/** false: shown only where the address asks for it */
	menu?: boolean;
	/** first view and light, written as in the address */
	view?: string;
}

/** All entries, those that no menu offers too. */
export async function loadMenu(): Promise<MenuEntry[]> {
	const response = await fetch('models/models.json');
	if (!response.ok) throw new Error(`models/models.json: got status ${response.status}, expected the list of models`);
	return response.json().catch(() => {
		throw new Error('models/models.json: got no JSON, expected the list of models');
	});
}

/** Entries that the menu of models offers. */
export function offered(entries: readonly MenuEntry[]): MenuEntry[] {
	return entries.filter(({ menu }) => menu !== false);
}

/** Pelts in the planes of the models: in the paper's basis, or in light curves fitted to that very fur. */
export function pelts(entries: readonly MenuEntry[], basis: 'ptm' | 'eigen' = 'ptm'): MenuEntry[] {
	return entries.filter((entry) => entry.pelt !== undefined && entry.basis === basis && !entry.fine);
}

/**
 * First light and camera of a model, or of a crowd.
 *
 * @param front azimuth of the model's face, radians from +z towards +x: where nothing else is said, the view is from there
 */
export function firstView(entry: MenuEntry | undefined, crowd = 1, front = 0): { light: Triple; camera: Triple } {
	const { light, camera } = parseAddress(entry?.view ?? '').view;
	const [azimuth, elevation, distance] = DEFAULT_CAMERA;
	const turned: Triple = [azimuth + MathUtils.radToDeg(front), elevation, distance];
	return {
		light: light ?? new Vector3(...DEFAULT_LIGHT).applyAxisAngle(Object3D.DEFAULT_UP, front).toArray(),
		camera: crowd > 1 ? CROWD_CAMERA : (camera ?? turned),
	};
}

/**
 * @param model a name of the menu, or a path or http address of a folder (or of the glTF file in it)
 * @returns the folder with a slash at its end; undefined for anything else
 */
export function folderOf(model: string, menu: readonly MenuEntry[], base: string): URL | undefined {
	const named = menu.some(({ name }) => name === model);
	if (!named && !/[./:]/.test(model)) return undefined;
	const path = named ? `models/${model}` : model.replace(/\/?(model\.gltf)?$/, '');
	if (!URL.canParse(`${path}/`, base)) return undefined;
	const url = new URL(`${path}/`, base);
	return /^https?:$/.test(url.protocol) ? url : undefined;
}
