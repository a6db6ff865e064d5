/** What is measured, as the page's address says it: `?run=1&rounds=3&size=640x360&parts=results`. */

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

export interface BenchAddress {
	options: BenchOptions;
	/** Whether they are those of a first look, but for what else the address says. */
	quick: boolean;
	/** Whether to begin by itself. */
	run: boolean;
	/** Path on this very site that the figures are sent to. */
	post: string | undefined;
	/** What was not understood, a line each; the default stands there. */
	problems: string[];
}

/** @param search `?...` of the page's address */
export function parseOptions(search: string): BenchAddress {
	const query = new URLSearchParams(search);
	const problems: string[] = [];
	const quick = query.get('quick') === '1';
	const options = { ...(quick ? QUICK : DEFAULTS) };

	const rounds = query.get('rounds');
	if (rounds !== null) {
		if (/^[1-9]\d?$/.test(rounds)) options.rounds = Number(rounds);
		else problems.push(`rounds=${rounds}: expected 1 to 99`);
	}
	const size = query.get('size');
	if (size !== null) {
		const [width = 0, height = 0] = (/^(\d{1,4})x(\d{1,4})$/.exec(size) ?? []).slice(1).map(Number);
		if (width >= 16 && height >= 16) Object.assign(options, { width, height });
		else problems.push(`size=${size}: expected width and height, 16 to 9999 pixels, as in 1280x720`);
	}
	options.parts = some('parts', PARTS, options.parts);
	options.methods = some('methods', METHODS, options.methods);
	options.triangles = some('triangles', DEFAULTS.triangles.map(String), options.triangles.map(String)).map(Number);
	const post = query.get('post');
	if (post !== null && !/^\/(?!\/)/.test(post)) problems.push(`post=${post}: expected a path on this site`);
	return {
		options,
		quick,
		run: query.get('run') === '1',
		post: post !== null && /^\/(?!\/)/.test(post) ? post : undefined,
		problems,
	};

	/** Those of a list that the address names, in the list's own order. */
	function some<T extends string>(name: string, all: readonly T[], otherwise: readonly T[]): readonly T[] {
		const named = query.get(name)?.split(',');
		if (!named) return otherwise;
		const odd = named.filter((item) => !all.includes(item as T));
		const found = all.filter((item) => named.includes(item));
		if (odd.length || !found.length) {
			problems.push(`${name}=${query.get(name)}: expected some of ${all.join(', ')}`);
			return otherwise;
		}
		return found;
	}
}
