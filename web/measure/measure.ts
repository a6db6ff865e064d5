/** The whole bench: what is measured, in which order, and what is made of it. */

import { Arena } from './arena.ts';
import { type BenchOptions, type Part, SHELLS } from './plan.ts';
import type { BenchFigures, Cost, CostName, Growth, Method, Point, Result, Row } from './results.ts';
import { type Extras, makeRival, type Rival } from './rivals.ts';
import { median, ratio } from './statistics.ts';
import { loadWardrobe, type Torus, type Wardrobe } from './tori.ts';

/** Where costs and curves are measured. */
const MIDDLE = 4608;
const CURVE_SHELLS = [8, 16, 32, 64];
/** Shares of the picture's width and height. */
const CURVE_SIZES = [0.25, 0.5, 0.75, 1];
const CURVE_METHODS: readonly Method[] = ['unlit', 'shadow-layers', 'ptm'];

const COSTS: [name: CostName, extras: Extras][] = [
	['highlight', { gloss: true }],
	['backlight', { backlight: true }],
	['shadow', { shadow: true }],
	['environment', { environment: true }],
	['all of them', { gloss: true, backlight: true, shadow: true, environment: true }],
];

/** A rival's picture, to be seen beside its figures. */
export interface Portrait {
	row: Row;
	width: number;
	height: number;
	/** Linear rgba, premultiplied; row by row from the bottom. */
	rgba: Float32Array;
}

export interface Listener {
	/** @param share done of the whole, 0..1; @param part that is being measured, once the models are there */
	progress(share: number, part?: Part): void;
	/** What is known so far. */
	figures(figures: BenchFigures): void;
	portraits(portraits: Portrait[]): void;
}

/** Of each part about how many frames it draws, in frames of the table at full size. */
function effort({ rounds, methods, triangles }: BenchOptions, part: Part): number {
	const rows = (2 + 2 * rounds) * (methods.length + 3) * triangles.length;
	const few = 2 + 2 * half(rounds);
	return {
		results: rows,
		layers: few * (methods.length + 2) * triangles.length,
		costs: (2 + 2 * rounds) * 12,
		curves: few * 30,
	}[part];
}

const half = (rounds: number) => Math.ceil(rounds / 2);

/** @returns all that was measured, as the listener has seen it grow */
export async function measure(options: BenchOptions, signal: AbortSignal, listener: Listener): Promise<BenchFigures> {
	const started = performance.now();
	listener.progress(0);
	const besides = options.parts.some((part) => part === 'costs' || part === 'curves') ? [MIDDLE] : [];
	const wardrobe = await loadWardrobe([...options.triangles, ...besides], options.methods);
	const arena = new Arena();
	try {
		const { device, clock } = arena.stopwatch;
		const figures: BenchFigures = {
			device,
			browser: navigator.userAgent,
			cores: navigator.hardwareConcurrency,
			clock,
			rounds: options.rounds,
			seconds: 0,
			results: [],
			results_of_layers: [],
			growth: [],
			costs: [],
			lights: [],
			curves: { shells: [], pixels: [] },
		};
		const bench = new Bench(options, arena, wardrobe, signal);
		const total = options.parts.reduce((sum, part) => sum + effort(options, part), 0);
		let before = 0;
		for (const part of options.parts) {
			const share = effort(options, part);
			bench.progress = (done, of) => listener.progress((before + (share * done) / of) / total, part);
			await bench[part](figures, listener);
			before += share;
			figures.seconds = Math.round((performance.now() - started) / 1000);
			listener.figures(figures);
		}
		return figures;
	} finally {
		arena.dispose();
		wardrobe.dispose();
	}
}

class Bench {
	progress: (done: number, total: number) => void = () => {};

	constructor(
		readonly options: BenchOptions,
		readonly arena: Arena,
		readonly wardrobe: Wardrobe,
		readonly signal: AbortSignal,
	) {}

	async results(figures: BenchFigures, listener: Listener): Promise<void> {
		const groups = this.#tori(this.wardrobe.tori).map((torus) => this.#table(torus, torus.fur.fins !== undefined));
		await this.#with(groups, async () => {
			const finest = groups.at(-1) ?? [];
			listener.portraits(
				finest.filter(({ row }) => !row.fins && row.light === 'moving').map((rival) => this.#portrait(rival)),
			);
			const times = await this.#contest(groups, this.options.rounds);
			figures.results = groups.flatMap((group) => this.#rows(group, times));
			figures.growth = growth(groups, times);
		});
	}

	async layers(figures: BenchFigures): Promise<void> {
		const groups = this.#tori(this.wardrobe.coarse).map((torus) => this.#table(torus, false));
		await this.#with(groups, async () => {
			const times = await this.#contest(groups, half(this.options.rounds));
			figures.results_of_layers = groups.flatMap((group) => this.#rows(group, times));
		});
	}

	async costs(figures: BenchFigures): Promise<void> {
		const make = (extras: Extras, row: Partial<Row> = {}) =>
			makeRival({ ...this.#row('ptm', MIDDLE), ...row }, this.#torus(), this.wardrobe, extras);
		const features = COSTS.map(([name, extras]) => ({ name, rival: make(extras) }));
		features.push({ name: 'all of them, and fins', rival: make(COSTS.at(-1)?.[1] ?? {}, { fins: true }) });
		const lights: { name: CostName; rival: Rival }[] = [
			{ name: 'a still light', rival: make({}, { light: 'still' }) },
			{ name: '8 lights', rival: make({ lights: 8 }) },
			{ name: 'fins', rival: make({}, { fins: true }) },
		];
		const [base, plain] = [make({}), make({})];
		const groups = [
			[base, ...features.map(({ rival }) => rival)],
			[plain, ...lights.map(({ rival }) => rival)],
		];
		await this.#with(groups, async () => {
			const times = await this.#contest(groups, this.options.rounds);
			const cost = (name: CostName, rival: Rival, over: Rival): Cost => {
				const rounds = times.get(rival) ?? [];
				return { name, median_ms: median(rounds), ratio: ratio(rounds, times.get(over) ?? []) };
			};
			figures.costs = [cost('plain', base, base), ...features.map(({ name, rival }) => cost(name, rival, base))];
			figures.lights = [
				cost('one, moving', plain, plain),
				...lights.map(({ name, rival }) => cost(name, rival, plain)),
			];
		});
	}

	async curves(figures: BenchFigures): Promise<void> {
		const { width, height } = this.options;
		const methods = CURVE_METHODS.filter((method) => this.options.methods.includes(method));
		const make = (row: Partial<Row>) =>
			methods.map((method) => makeRival({ ...this.#row(method, MIDDLE), ...row }, this.#torus(), this.wardrobe));
		const shells = CURVE_SHELLS.map((count) => make({ shells: count }));
		const pixels = CURVE_SIZES.map((share) =>
			make({ width: Math.round(width * share), height: Math.round(height * share) }),
		);
		const groups = [...shells, ...pixels];
		await this.#with(groups, async () => {
			const times = await this.#contest(groups, half(this.options.rounds));
			const points = (those: Rival[][]): Point[] =>
				those.flat().map((rival) => ({ ...rival.row, median_ms: median(times.get(rival) ?? []) }));
			figures.curves = { shells: points(shells), pixels: points(pixels) };
		});
	}

	/** The rivals of one table row after the other: all methods, and what some of them can have besides. */
	#table({ triangles, ...torus }: Torus, fins: boolean): Rival[] {
		const { methods } = this.options;
		const rows = methods.map((method) => this.#row(method, triangles));
		for (const method of ['shadow-layers', 'ptm'] as const) {
			if (methods.includes(method)) rows.push({ ...this.#row(method, triangles), light: 'still' });
		}
		if (fins && methods.includes('ptm')) rows.push({ ...this.#row('ptm', triangles), fins: true });
		return rows.map((row) => makeRival(row, { triangles, ...torus }, this.wardrobe));
	}

	#row(method: Method, triangles: number): Row {
		const { width, height } = this.options;
		return { method, light: 'moving', fins: false, triangles, shells: SHELLS, width, height };
	}

	#tori(of: Map<number, Torus>): Torus[] {
		const wanted = this.options.triangles;
		return [...of.values()].filter(({ fur }) =>
			[...this.wardrobe.tori].some(([triangles, torus]) => torus.fur === fur && wanted.includes(triangles)),
		);
	}

	#torus(): Torus {
		const torus = this.wardrobe.tori.get(MIDDLE);
		if (!torus) throw new Error(`torus-${MIDDLE}: it was not loaded`);
		return torus;
	}

	#contest(groups: Rival[][], rounds: number): Promise<Map<Rival, number[]>> {
		return this.arena.contest(groups, rounds, this.signal, (done, total) => this.progress(done, total));
	}

	/** Disposes of rivals whatever happens to them. */
	async #with(groups: Rival[][], body: () => Promise<void>): Promise<void> {
		try {
			await body();
		} finally {
			for (const rival of groups.flat()) rival.dispose();
		}
	}

	#rows(group: Rival[], times: Map<Rival, number[]>): Result[] {
		const over = (method: Method, rounds: number[]) => {
			const base = group.find(({ row }) => row.method === method && row.light === 'moving');
			return ratio(rounds, (base && times.get(base)) ?? []);
		};
		return group.map((rival) => {
			const rounds = times.get(rival) ?? [];
			return {
				...rival.row,
				median_ms: median(rounds),
				ratio_to_unlit: over('unlit', rounds),
				ratio_to_shadow_layers: over('shadow-layers', rounds),
				overdraw: rival.row.method === 'ptm' && rival.row.light === 'moving' ? this.arena.overdraw(rival) : null,
			};
		});
	}

	#portrait(rival: Rival): Portrait {
		const [width, height] = [480, 270];
		return { row: rival.row, width, height, rgba: this.arena.picture(rival, width, height) };
	}
}

/** From each size to the next, of what every size has. */
function growth(groups: Rival[][], times: Map<Rival, number[]>): Growth[] {
	return groups.slice(1).flatMap((group, i) =>
		group.flatMap((rival, r) => {
			const smaller = groups[i]?.[r];
			if (!smaller || rival.row.light === 'still' || rival.row.fins) return [];
			return [
				{
					method: rival.row.method,
					from: smaller.row.triangles,
					to: rival.row.triangles,
					ratio: ratio(times.get(rival) ?? [], times.get(smaller) ?? []),
				},
			];
		}),
	);
}
