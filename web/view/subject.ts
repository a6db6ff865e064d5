/** A model and the fur that it wears, from their addresses. */

import type { LoadingManager } from 'three';
import { dressFur, type FurLimits } from '../fur/index.ts';
import { loadModel, loadPelt } from '../scene/load.ts';
import type { Model } from '../scene/model.ts';
import type { Shown } from './FurPicture.ts';

/** Pelt of a preset: its glTF file, and how it is worn. */
export interface Pelt {
	url: string;
	/** share of the body's second tip colour, 0..1 */
	tips?: number;
	/** strength of its highlights */
	gloss?: number;
}

/** Entry of the list of models, as far as pelts are concerned. */
interface Entry {
	name: string;
	pelt?: string;
	basis?: string;
	fine?: boolean;
	tips?: number;
	gloss?: number;
}

/** Address of a glTF file: the given one, or that of `model.gltf` in the given folder. */
export function gltfAt(address: string, base: string): string {
	const url = new URL(address, base);
	if (!/\.(gltf|glb)$/i.test(url.pathname)) url.pathname = `${url.pathname.replace(/\/$/, '')}/model.gltf`;
	return url.href;
}

/**
 * Finds the pelt of a preset.
 *
 * @param preset a name of the list `models.json` beside the model's folder, or the address of a pelt's folder or glTF file
 * @param model address of the model's glTF file; @param base of relative addresses
 * @throws Error where the list has no such name
 */
export async function findPelt(preset: string, model: string, base: string, signal?: AbortSignal): Promise<Pelt> {
	if (/[./]/.test(preset)) return { url: gltfAt(preset, base) };
	const list = new URL('../models.json', model);
	const response = await fetch(list, signal ? { signal } : {});
	if (!response.ok) throw new Error(`models.json: got status ${response.status}, expected the list of presets`);
	const entries = ((await response.json()) as Entry[]).filter(
		({ pelt, basis, fine }) => pelt && basis === 'ptm' && !fine,
	);
	const found = entries.find(({ pelt }) => pelt === preset);
	if (!found) throw new Error(`got ${preset}, expected one of ${entries.map(({ pelt }) => pelt).join(', ')}`);
	const { name, tips, gloss } = found;
	return {
		url: new URL(`${name}/model.gltf`, list).href,
		...(tips !== undefined && { tips }),
		...(gloss !== undefined && { gloss }),
	};
}

/** Loads a model. @throws Error of one sentence */
export function loadBody(url: string, limits: FurLimits, manager: LoadingManager): Promise<Model> {
	return loadModel({ url, manager }, limits);
}

/** Loads a pelt, and dresses a model in it. @throws Error of one sentence */
export async function dress(model: Model, pelt: Pelt, limits: FurLimits, manager: LoadingManager): Promise<Shown> {
	if (!model.fur) throw new Error('got a model without fur, expected one to dress');
	const own = await loadPelt({ url: pelt.url, manager }, limits);
	const fur = dressFur(model.fur, own, { ...(pelt.tips !== undefined && { tips: pelt.tips }) });
	model.fur.visible = false;
	const dispose = () => {
		// Never drawn, the model's own geometry frees nothing on the GPU: that which was drawn does, while it has its attributes.
		for (const part of [fur.shells, fur.fins]) part?.dispose();
		for (const part of [fur, model, own]) part.dispose();
	};
	return { model, fur, gloss: pelt.gloss, dispose };
}

/** A model in its own fur. */
export function plain(model: Model): Shown {
	return { model, fur: model.fur, dispose: () => model.dispose() };
}
