/** The bodies that are measured: baked tori, and coarser ones of some of their vertices. */

import { BufferAttribute, BufferGeometry } from 'three';
import type { Fur } from '../fur/index.ts';
import { TORI } from './plan.ts';
import { METHODS, type Method } from './results.ts';
import { loadFur } from './studio.ts';

/** Every so many rows and columns of a baked torus make the one whose triangles are those of one of 16 layers. */
const STEP = 4;

/** A body and where it stands. */
export interface Torus {
	triangles: number;
	/** As the shells want it. */
	surface: BufferGeometry;
	/** The baked model that it belongs to. */
	fur: Fur;
}

/** All that was loaded. */
export interface Wardrobe {
	/** With six numbers a texel, by the number of triangles. */
	tori: Map<number, Torus>;
	/** With fewer triangles, on the same vertices. */
	coarse: Map<number, Torus>;
	/** Of the methods that have a pelt of their own. It is made once: tile and length are the same on any body. */
	pelts: Map<Method, Fur>;
	dispose(): void;
}

/**
 * A lattice of triangles, two a cell, over every `step`th of the vertices.
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

/** The surface that shells are instances of, by itself. */
function plain({ index, attributes }: BufferGeometry): BufferGeometry {
	const surface = new BufferGeometry();
	surface.setIndex(index);
	for (const [name, attribute] of Object.entries(attributes)) surface.setAttribute(name, attribute);
	return surface;
}

/** Whose texels some methods look up. */
const PELTS: [method: Method, model: string][] = [
	['ptm3', 'torus-512-eigen3'],
	['ptm-colour', 'torus-512-colour'],
];

/** @param triangles of the tori that are wanted */
export async function loadWardrobe(
	triangles: readonly number[],
	methods: readonly Method[] = METHODS,
): Promise<Wardrobe> {
	// Without anisotropy: of a software rasteriser's frame it would be the most.
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
