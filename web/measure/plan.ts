/** What can be measured, and what is unless asked otherwise. */

import { METHODS, type Method } from './results.ts';

/** The bodies of the article's Table 1: rows around the tube and columns around the ring, two triangles a cell. */
export const TORI = [
	{ triangles: 512, rows: 16, columns: 16 },
	{ triangles: 4608, rows: 48, columns: 48 },
	{ triangles: 16896, rows: 88, columns: 96 },
] as const;

/** Layers of the article's fur, and the shells of the table. */
export const SHELLS = 16;

/** The table; the same with its triangles as sums over the layers; what features cost; frames against size. */
export const PARTS = ['results', 'layers', 'costs', 'curves'] as const;
export type Part = (typeof PARTS)[number];

export interface BenchOptions {
	/** Of the table; costs have as many, the others half. */
	rounds: number;
	/** Pixels. */
	width: number;
	height: number;
	parts: readonly Part[];
	methods: readonly Method[];
	/** Sizes of the table, of those of `TORI`. */
	triangles: readonly number[];
}

export const DEFAULTS: BenchOptions = {
	rounds: 7,
	width: 1280,
	height: 720,
	parts: PARTS,
	methods: METHODS,
	triangles: TORI.map(({ triangles }) => triangles),
};

/** For a first look: the table alone, a quarter of the pixels. */
export const QUICK: BenchOptions = { ...DEFAULTS, rounds: 2, width: 640, height: 360, parts: ['results'] };
