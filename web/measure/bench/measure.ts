/** Whole bench: parts, their order, and the figures made of them. */

import { median, ratio } from '../statistics.ts';
import { Comparison } from './Comparison.ts';
import { makeHerd } from './herd.ts';
import { type BenchOptions, CARD, PARTS, type Part, SHELLS } from './plan.ts';
import type { BenchFigures, CardPoint, Cost, CostName, Growth, Method, Point, Result, Row } from './results.ts';
import { type Extras, makeSubject, type Subject } from './subjects.ts';
import { type BenchModels, loadBenchModels, type Torus } from './tori.ts';

/** Triangles of the body for costs and curves. */
const MIDDLE = 4608;
/** Shells for the cost of many of them. */
const MANY = 48;
const CURVE_SHELLS = [8, 16, 32, 64];
/** Sizes of curves, shares of the picture's width and height. */
const CURVE_SIZES = [0.25, 0.5, 0.75, 1];
const CURVE_METHODS: readonly Method[] = ['unlit', 'shadow-layers', 'ptm'];

const COSTS: [name: CostName, extras: Extras][] = [
	['highlight', { gloss: true }],
	['backlight', { backlight: true }],
	['shadow', { shadow: true }],
	['environment', { environment: true }],
	['all of them', { gloss: true, backlight: true, shadow: true, environment: true }],
];

/** Picture of a method. */
export interface MethodPicture {
	row: Row;
	width: number;
	height: number;
	/** Linear rgba, premultiplied; row by row from the bottom. */
	rgba: Float32Array;
}

export interface Listener {
	/** @param share done share of the whole, 0..1; @param part part being measured, once the models are loaded */
	progress(share: number, part?: Part): void;
	/** Figures so far. */
	figures(figures: BenchFigures): void;
	methodPictures(methodPictures: MethodPicture[]): void;
}

/** Estimated effort of a part, in frames of the table at full size. */
function effort({ rounds, methods, triangles }: BenchOptions, part: Part): number {
	const rows = (2 + 2 * rounds) * (methods.length + 3) * triangles.length;
	const few = 2 + 2 * half(rounds);
	return {
		results: rows,
		layers: few * (methods.length + 2) * triangles.length,
		costs: (2 + 2 * rounds) * 18,
		curves: few * 30,
		card: few * CARD.bodies.length * CARD.shells.length * 10,
	}[part];
}

const half = (rounds: number) => Math.ceil(rounds / 2);

/** @returns all figures, as reported to the listener step by step */
export async function measure(options: BenchOptions, signal: AbortSignal, listener: Listener): Promise<BenchFigures> {
	const started = performance.now();
	listener.progress(0);
	const comparison = new Comparison();
	const { device, clock, software } = comparison.stopwatch;
	const parts = options.parts ?? PARTS.filter((part) => part !== 'card' || !software);
	const besides = parts.some((part) => part === 'costs' || part === 'curves' || part === 'card') ? [MIDDLE] : [];
	let models: BenchModels | undefined;
	try {
		models = await loadBenchModels([...options.triangles, ...besides], options.methods);
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
			card: [],
		};
		const bench = new Bench(options, comparison, models, signal);
		const total = parts.reduce((sum, part) => sum + effort(options, part), 0);
		let before = 0;
		for (const part of parts) {
			const share = effort(options, part);
			bench.progress = (done, of) => listener.progress((before + (share * done) / of) / total, part);
			await bench[part](figures, listener);
			before += share;
			figures.seconds = Math.round((performance.now() - started) / 1000);
			listener.figures(figures);
		}
		return figures;
	} finally {
		comparison.dispose();
		models?.dispose();
	}
}

class Bench {
	progress: (done: number, total: number) => void = () => {};

	constructor(
		readonly options: BenchOptions,
		readonly comparison: Comparison,
		readonly models: BenchModels,
		readonly signal: AbortSignal,
	) {}

	async results(figures: BenchFigures, listener: Listener): Promise<void> {
		const groups = this.#tori(this.models.tori).map((torus) => this.#table(torus, torus.fur.fins !== undefined));
		await this.#with(groups, async () => {
			const finest = groups.at(-1) ?? [];
			listener.methodPictures(
				finest.filter(({ row }) => !row.fins && row.light === 'moving').map((subject) => this.#pictureOf(subject)),
			);
			const times = await this.#timeInTurn(groups, this.options.rounds);
			figures.results = groups.flatMap((group) => this.#rows(group, times));
			figures.growth = growth(groups, times);
		});
	}

	async layers(figures: BenchFigures): Promise<void> {
		const groups = this.#tori(this.models.coarse).map((torus) => this.#table(torus, false));
		await this.#with(groups, async () => {
			const times = await this.#timeInTurn(groups, half(this.options.rounds));
			figures.results_of_layers = groups.flatMap((group) => this.#rows(group, times));
		});
	}

	async costs(figures: BenchFigures): Promise<void> {
		const make = (extras: Extras, row: Partial<Row> = {}) =>
			this.#subject({ ...this.#row('ptm', MIDDLE), ...row }, this.#torus(), extras);
		const features = COSTS.map(([name, extras]) => ({ name, subject: make(extras) }));
		features.push({ name: 'all of them, and fins', subject: make(COSTS.at(-1)?.[1] ?? {}, { fins: true }) });
		const lights: { name: CostName; subject: Subject }[] = [
			{ name: 'a still light', subject: make({}, { light: 'still' }) },
			{ name: '8 lights', subject: make({ lights: 8 }) },
			{ name: 'fins', subject: make({}, { fins: true }) },
			{ name: 'merged shells', subject: make({ merged: true }) },
			{ name: '48 shells', subject: make({}, { shells: MANY }) },
			{ name: '48 shells, merged', subject: make({ merged: true }, { shells: MANY }) },
		];
		const [base, plain] = [make({}), make({})];
		const groups = [
			[base, ...features.map(({ subject }) => subject)],
			[plain, ...lights.map(({ subject }) => subject)],
		];
		await this.#with(groups, async () => {
			const times = await this.#timeInTurn(groups, this.options.rounds);
			const cost = (name: CostName, subject: Subject, over: Subject): Cost => {
				const rounds = times.get(subject) ?? [];
				return { name, median_ms: median(rounds), ratio: ratio(rounds, times.get(over) ?? []) };
			};
			figures.costs = [cost('plain', base, base), ...features.map(({ name, subject }) => cost(name, subject, base))];
			figures.lights = [
				cost('one, moving', plain, plain),
				...lights.map(({ name, subject }) => cost(name, subject, plain)),
			];
		});
	}

	async curves(figures: BenchFigures): Promise<void> {
		const { width, height } = this.options;
		const methods = CURVE_METHODS.filter((method) => this.options.methods.includes(method));
		const make = (row: Partial<Row>) =>
			methods.map((method) => this.#subject({ ...this.#row(method, MIDDLE), ...row }, this.#torus()));
		const shells = CURVE_SHELLS.map((count) => make({ shells: count }));
		const pixels = CURVE_SIZES.map((share) =>
			make({ width: Math.round(width * share), height: Math.round(height * share) }),
		);
		const groups = [...shells, ...pixels];
		await this.#with(groups, async () => {
			const times = await this.#timeInTurn(groups, half(this.options.rounds));
			const points = (those: Subject[][]): Point[] =>
				those.flat().map((subject) => ({ ...subject.row, median_ms: median(times.get(subject) ?? []) }));
			figures.curves = { shells: points(shells), pixels: points(pixels) };
		});
	}

	async card(figures: BenchFigures): Promise<void> {
		const torus = this.#torus();
		const points = CARD.sizes.flatMap((size) => {
			const [width, height] = [Math.round(this.options.width * size), Math.round(this.options.height * size)];
			return CARD.shells.flatMap((shells) => CARD.bodies.map((bodies) => ({ width, height, shells, bodies })));
		});
		const subjects = points.map(({ bodies, ...size }) => {
			const row: Row = { ...this.#row('ptm', MIDDLE), fins: true, ...size };
			return bodies === 1 ? this.#subject(row, torus) : makeHerd(row, torus, bodies);
		});
		await this.#with([subjects], async () => {
			const times = await this.#timeInTurn([subjects], half(this.options.rounds));
			figures.card = subjects.map(
				(subject, i): CardPoint => ({
					...subject.row,
					bodies: points[i]?.bodies ?? 1,
					median_ms: median(times.get(subject) ?? []),
				}),
			);
		});
	}

	/** Subjects of a table: all methods, and some with a still light or with fins. */
	#table({ triangles, ...torus }: Torus, fins: boolean): Subject[] {
		const { methods } = this.options;
		const rows = methods.map((method) => this.#row(method, triangles));
		for (const method of ['shadow-layers', 'ptm'] as const) {
			if (methods.includes(method)) rows.push({ ...this.#row(method, triangles), light: 'still' });
		}
		if (fins && methods.includes('ptm')) rows.push({ ...this.#row('ptm', triangles), fins: true });
		return rows.map((row) => this.#subject(row, { triangles, ...torus }));
	}

	#subject(row: Row, torus: Torus, extras?: Extras): Subject {
		return makeSubject(this.comparison.renderer, row, torus, this.models, extras);
	}

	#row(method: Method, triangles: number): Row {
		const { width, height } = this.options;
		return { method, light: 'moving', fins: false, triangles, shells: SHELLS, width, height };
	}

	#tori(of: Map<number, Torus>): Torus[] {
		const wanted = this.options.triangles;
		return [...of.values()].filter(({ fur }) =>
			[...this.models.tori].some(([triangles, torus]) => torus.fur === fur && wanted.includes(triangles)),
		);
	}

	#torus(): Torus {
		const torus = this.models.tori.get(MIDDLE);
		if (!torus) throw new Error(`torus-${MIDDLE}: it was not loaded`);
		return torus;
	}

	#timeInTurn(groups: Subject[][], rounds: number): Promise<Map<Subject, number[]>> {
		return this.comparison.timeInTurn(groups, rounds, this.signal, (done, total) => this.progress(done, total));
	}

	/** Run a body and dispose of subjects in any case. */
	async #with(groups: Subject[][], body: () => Promise<void>): Promise<void> {
		try {
			await body();
		} finally {
			for (const subject of groups.flat()) subject.dispose();
		}
	}

	#rows(group: Subject[], times: Map<Subject, number[]>): Result[] {
		const over = (method: Method, rounds: number[]) => {
			const base = group.find(({ row }) => row.method === method && row.light === 'moving');
			return ratio(rounds, (base && times.get(base)) ?? []);
		};
		return group.map((subject) => {
			const rounds = times.get(subject) ?? [];
			return {
				...subject.row,
				median_ms: median(rounds),
				ratio_to_unlit: over('unlit', rounds),
				ratio_to_shadow_layers: over('shadow-layers', rounds),
				overdraw:
					subject.row.method === 'ptm' && subject.row.light === 'moving' ? this.comparison.overdraw(subject) : null,
			};
		});
	}

	#pictureOf(subject: Subject): MethodPicture {
		const [width, height] = [480, 270];
		return { row: subject.row, width, height, rgba: this.comparison.picture(subject, width, height) };
	}
}

/** Growth of time from each size to the next, for methods measured at every size. */
function growth(groups: Subject[][], times: Map<Subject, number[]>): Growth[] {
	return groups.slice(1).flatMap((group, i) =>
		group.flatMap((subject, r) => {
			const smaller = groups[i]?.[r];
			if (!smaller || subject.row.light === 'still' || subject.row.fins) return [];
			return [
				{
					method: subject.row.method,
					from: smaller.row.triangles,
					to: subject.row.triangles,
					ratio: ratio(times.get(subject) ?? [], times.get(smaller) ?? []),
				},
			];
		}),
	);
}
