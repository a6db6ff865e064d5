/** Figures of the bench as posted; other people's scripts rely on the shape of `results`. */

/** Methods of the bench. `ptm-colour` is the paper's own form, with a third fetch for the texel's colour and without mean curves. */
export const METHODS = ['unlit', 'lengyel', 'shadow-layers', 'ptm', 'ptm3', 'ptm-colour'] as const;
export type Method = (typeof METHODS)[number];

/** Row of the table: one method on one model. */
export interface Row {
	method: Method;
	/** Whether the light moves every frame. */
	light: 'moving' | 'still';
	fins: boolean;
	/** Triangles of the body, and of every shell. */
	triangles: number;
	shells: number;
	/** Pixels. */
	width: number;
	height: number;
}

export interface Result extends Row {
	/** Median time of a frame, milliseconds. */
	median_ms: number;
	/** Median over the rounds of this row's time over that of `unlit` in the same round. */
	ratio_to_unlit: number;
	/** Median over the rounds of this row's time over that of `shadow-layers` under the moving light. */
	ratio_to_shadow_layers: number;
	/** Overdraw of PTM, whose shells all methods draw; null for others and where floats cannot be blended. */
	overdraw: Overdraw | null;
}

/** Fragments per covered pixel. */
export interface Overdraw {
	/** Share of the picture's pixels with any fragment. */
	covered: number;
	/** Fragments in front of the skin, dropped and hidden ones included: upper bound of the shaded ones. */
	shaded: number;
	/** Fragments in the final picture. */
	blended: number;
}

/** Name of a variant of the bench's plain PTM: features, lights or fins. */
export type CostName =
	| 'plain'
	| 'highlight'
	| 'backlight'
	| 'shadow'
	| 'environment'
	| 'all of them'
	| 'all of them, and fins'
	| 'one, moving'
	| 'a still light'
	| '8 lights'
	| 'fins'
	| 'merged shells'
	| '48 shells'
	| '48 shells, merged';

/** Cost of a variant against the bench's plain PTM. */
export interface Cost {
	name: CostName;
	median_ms: number;
	/** Median over the rounds of its time over that of the base in the same round. */
	ratio: number;
}

/** Growth of one method's time from one size of model to the next, measured in the same rounds. */
export interface Growth {
	method: Method;
	from: number;
	to: number;
	ratio: number;
}

export interface Point extends Row {
	median_ms: number;
}

/** Time of a full picture of one or many bodies with fins, PTM under a moving lamp. */
export interface CardPoint extends Point {
	bodies: number;
}

export interface BenchFigures {
	/** Device as reported by the browser. */
	device: string;
	browser: string;
	/** Processor cores as reported by the browser. */
	cores: number;
	/** Clock of a frame: up to `readPixels` of one pixel, or a timer query of the GPU. */
	clock: 'readPixels' | 'timer query';
	rounds: number;
	/** Seconds of the whole run. */
	seconds: number;
	results: Result[];
	/** Results with numbers of triangles as sums over all 16 layers. */
	results_of_layers: Result[];
	growth: Growth[];
	/** Cost of features of the PTM with 4 608 triangles, each by itself and all together. */
	costs: Cost[];
	/** Cost of lights and fins of the PTM with 4 608 triangles. */
	lights: Cost[];
	/** Time against the number of shells and against the size of the picture. */
	curves: { shells: Point[]; pixels: Point[] };
	/** Full pictures and herds; empty where the processor draws, unless asked for. */
	card: CardPoint[];
}

/** Row of the article's Table 1, or the same measured here: frames per second with one number of triangles. */
export interface Table1Row {
	/** Triangles of the body as measured here, and of each of 16 shells. */
	triangles: number;
	layered: { fps: number };
	ptm: { fps: number };
	/** Speed of the PTM over shadow maps; measured here as the median over rounds of turns there and back. */
	ratio: number;
}

/** Figures of the article, on a Quadro NVS 110 with 64 MB. */
export const ARTICLE: readonly Table1Row[] = [
	{ triangles: 512, layered: { fps: 41.6 }, ptm: { fps: 57.3 }, ratio: 57.3 / 41.6 },
	{ triangles: 4608, layered: { fps: 14.3 }, ptm: { fps: 17.4 }, ratio: 17.4 / 14.3 },
	{ triangles: 16896, layered: { fps: 5.7 }, ptm: { fps: 7.7 }, ratio: 7.7 / 5.7 },
];
