/** Options of the bench, and their defaults. */

import { METHODS, type Method } from './results.ts';

/** The bodies of the article's Table 1: rows around the tube and columns around the ring, two triangles a cell. */
export const TORI = [
	{ triangles: 512, rows: 16, columns: 16 },
	{ triangles: 4608, rows: 48, columns: 48 },
	{ triangles: 16896, rows: 88, columns: 96 },
] as const;

/** Number of layers of the article's fur, and of shells in the table. */
export const SHELLS = 16;

/**
 * Parts: the table; the table with triangles as sums over layers; cost of features; time against size; full pictures and
 * herds, which only a graphics card draws in reasonable time.
 */
export const PARTS = ['results', 'layers', 'costs', 'curves', 'card'] as const;
export type Part = (typeof PARTS)[number];

/** Sizes of the part `card` over those of the picture (1080p and 4K by default), its shells and numbers of bodies. */
export const CARD = {
	sizes: [1.5, 3],
	shells: [16, 32, 64],
	bodies: [1, 100],
} as const;

export interface BenchOptions {
	/** Rounds of the table and of costs; other parts have half as many. */
	rounds: number;
	/** Pixels. */
	width: number;
	height: number;
	/** Parts to measure; `undefined`: all that the device can draw in reasonable time. */
	parts: readonly Part[] | undefined;
	methods: readonly Method[];
	/** Numbers of triangles in the table, out of `TORI`. */
	triangles: readonly number[];
}

export const DEFAULTS: BenchOptions = {
	rounds: 7,
	width: 1280,
	height: 720,
	parts: undefined,
	methods: METHODS,
	triangles: TORI.map(({ triangles }) => triangles),
};

/** Options of a first look: the table alone, a quarter of the pixels. */
export const QUICK: BenchOptions = { ...DEFAULTS, rounds: 2, width: 640, height: 360, parts: ['results'] };
