/** Bodies of the bench: baked tori, and coarser ones of some of their vertices. */

import { BufferAttribute, BufferGeometry } from 'three';
import type { Fur } from '../../fur/index.ts';
import { loadFur } from '../studio.ts';
import { TORI } from './plan.ts';
import { METHODS, type Method } from './results.ts';

/** Step in rows and columns from a baked torus to the one with a sixteenth of its triangles. */
const STEP = 4;

/** Body and its placement. */
export interface Torus {
	triangles: number;
	/** Surface for the shells. */
	surface: BufferGeometry;
	/** Baked model of the surface. */
	fur: Fur;
}

/** Loaded models. */
export interface BenchModels {
	/** Tori with six numbers a texel, by number of triangles. */
	tori: Map<number, Torus>;
	/** Tori with fewer triangles, on the same vertices. */
	coarse: Map<number, Torus>;
	/** Pelts of methods that have their own. One for all bodies: tile and length are the same on each. */
	pelts: Map<Method, Fur>;
	dispose(): void;
}

/**
 * Lattice of triangles, two a cell, over every `step`th vertex.
 *
 * @param surface (rows + 1)·(columns + 1) vertices, the columns fastest
 */
export function everyNth(surface: BufferGeometry, rows: number, columns: number, step: number): BufferGeometry {
	const { count } = surface.getAttribute('position');
	const wanted = (rows + 1) * (columns + 1);
	if (count !== wanted)
		throw new Error(`a torus of ${rows} rows and ${columns} columns: got ${count} vertices, expected ${wanted}`);
	const corners: number[] = [];
	for (let row = 0; row < rows; row += step) {
		for (let column = 0; column < columns; column += step) {
			const a = row * (columns + 1) + column;
			const b = a + step * (columns + 1);
			corners.push(a, b, b + step, a, b + step, a + step);
		}
	}
	const coarse = plain(surface);
	coarse.setIndex(new BufferAttribute(new Uint16Array(corners), 1));
	return coarse;
}

/** Surface of the shells, without instancing. */
function plain({ index, attributes }: BufferGeometry): BufferGeometry {
	const surface = new BufferGeometry();
	surface.setIndex(index);
	for (const [name, attribute] of Object.entries(attributes)) surface.setAttribute(name, attribute);
	return surface;
}

/** Models with a method's own texels. */
const PELTS: [method: Method, model: string][] = [
	['ptm3', 'torus-512-eigen3'],
	['ptm-colour', 'torus-512-colour'],
];

/** @param triangles numbers of triangles of the wanted tori */
export async function loadBenchModels(
	triangles: readonly number[],
	methods: readonly Method[] = METHODS,
): Promise<BenchModels> {
	// Without anisotropy, which would dominate a software rasteriser's frame.
	const load = (name: string) =>
		loadFur(new URL(`models/${name}/model.gltf`, document.baseURI).href, { anisotropy: 1 });
	const sizes = TORI.filter((size) => triangles.includes(size.triangles));
	const others = PELTS.filter(([method]) => methods.includes(method));
	const [furs, pelts] = await Promise.all([
		Promise.all(sizes.map((size) => load(`torus-${size.triangles}`))),
		Promise.all(others.map(async ([method, model]) => [method, await load(model)] as const)),
	]);
	const tori = new Map<number, Torus>();
	const coarse = new Map<number, Torus>();
	furs.forEach((fur, i) => {
		const { triangles, rows, columns } = sizes[i] ?? TORI[0];
		const surface = plain(fur.shells.geometry);
		if (surface.hasAttribute('_comb')) throw new Error(`torus-${triangles}: got combed fur, expected it as it grows`);
		const few = triangles / STEP ** 2;
		tori.set(triangles, { triangles, surface, fur });
		coarse.set(few, { triangles: few, surface: everyNth(surface, rows, columns, STEP), fur });
	});
	return {
		tori,
		coarse,
		pelts: new Map(pelts),
		dispose() {
			for (const { surface } of [...tori.values(), ...coarse.values()]) surface.dispose();
			for (const fur of [...furs, ...pelts.map(([, pelt]) => pelt)]) fur.dispose();
		},
	};
}
