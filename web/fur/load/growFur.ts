/** Fur of a loaded scene. Fetched with the first asset that has fur. */

import { Color, type Mesh, type MeshStandardMaterial, type Object3D } from 'three';
import type { GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import type { checkGeometry } from '../body/checkGeometry.ts';
import { loadRoots } from '../body/roots/Roots.ts';
import { Skin } from '../body/skin/Skin.ts';
import { Fur } from '../Fur.ts';
import type { FurAsset, Pelt } from '../format.ts';
import type { GltfFiles } from '../planes/GltfFiles.ts';
import { type Cut, PeltStates } from '../planes/PeltStates.ts';
import { parts } from '../shells/parts/parts.ts';
import { finCut, shellCut } from './cuts.ts';
import { Meshes } from './Meshes.ts';
import type { FurLoaderOptions } from './options.ts';

/** Layers per texture that every GPU with WebGL2 allows. */
const MIN_LAYERS = 256;

/** An asset and its files. */
export interface Source {
	parser: GLTFParser;
	files: GltfFiles;
	options: FurLoaderOptions;
	/** Code of the fins, for assets that have some. */
	fins: typeof import('./fins.ts') | undefined;
	/** Check of a geometry; undefined: it is trusted. */
	check: typeof checkGeometry | undefined;
}

/** @throws Error that says what is wrong with the asset */
export async function growFur(asset: FurAsset, scene: Object3D, source: Source): Promise<Fur> {
	const { parser, files, options } = source;
	const meshes = new Meshes(parser, asset, source.check);
	const pelt = asset.pelts[0] as Pelt;
	const { fins } = source;
	const fin = fins && pelt.fin;
	const [{ skin, surface, colour }, roots, shells, quads, sides] = await Promise.all([
		bodyOf(meshes, () => options.skin?.(scene)),
		loadRoots(parser, asset),
		shellCut(asset, files, options.anisotropy),
		fin && meshes.quads(fins.finQuads),
		fin && finCut(asset, files, fin),
	]);
	const ground = {
		skin,
		colour,
		roots,
		surface: surface.geometry,
		placement: surface,
		quads: quads?.geometry,
		quadPlacement: quads,
		finHeights: asset.tiles ?? 1,
		growFins: fins?.growFins,
	};
	const cuts = [shells, sides].filter((cut) => cut !== undefined) as [Cut, Cut?];
	const { states = Number.POSITIVE_INFINITY, limits = { layers: MIN_LAYERS } } = options;
	const worn = new PeltStates(asset, cuts, states, limits.layers);
	return new Fur(asset, worn, ground, 'body');
}

/** Skin, shells' mesh and base colour; the skin stays unshaded until there is fur. @param ready called once it can be shown */
async function bodyOf(meshes: Meshes, ready: () => void): Promise<{ skin: Skin; surface: Mesh; colour: Color }> {
	const [surface, { object, pieces }] = await Promise.all([meshes.shells(), meshes.skin()]);
	// Vertex colours of the shells already contain the base colour of every material or picture.
	const own = pieces[0]?.material as MeshStandardMaterial | undefined;
	const colour = (!surface.geometry.hasAttribute('color') && own?.color) || new Color(1, 1, 1);
	const together = object.matrix.equals(surface.matrix);
	const skin = new Skin(object, pieces, together ? surface.geometry : undefined, parts.pose?.FurPose.of);
	ready();
	return { skin, surface, colour };
}
