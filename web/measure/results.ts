/** What the bench measures, as the page hands it on; `results` has the shape that other people's scripts rely on. */

/** What a shell may be lit by. `ptm-colour` is the paper's own form, with a third fetch for the texel's colour and without mean curves. */
export const METHODS = ['unlit', 'lengyel', 'shadow-layers', 'ptm', 'ptm3', 'ptm-colour'] as const;
export type Method = (typeof METHODS)[number];

/** One rival on one model: a row of the table. */
export interface Row {
	method: Method;
	/** Whether the light is in another place every frame. */
	light: 'moving' | 'still';
	fins: boolean;
	/** Of the body; every shell has as many. */
	triangles: number;
	shells: number;
	/** Pixels. */
	width: number;
	height: number;
}

export interface Result extends Row {
	/** Of a frame, milliseconds. */
	median_ms: number;
	/** Median over the rounds of this row's time over that of `unlit` in the same round. */
	ratio_to_unlit: number;
	/** The same over that of `shadow-layers` under the moving light. */
	ratio_to_shadow_layers: number;
	/** Of PTM, whose shells all methods draw; null for others and where the machine cannot blend floats. */
	overdraw: Overdraw | null;
}

/** Fragments per pixel that fur covers. */
export interface Overdraw {
	/** Share of the picture's pixels that any fragment reaches. */
	covered: number;
	/** In front of the skin, whether they are dropped or hidden by other fur or not: what can be shaded at the most. */
	shaded: number;
	/** That end up in the picture. */
	blended: number;
}

/** What is measured beside the bench's plain PTM: its features, and its lights and fins. */
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
	| 'fins';

/** What something costs beside the bench's plain PTM. */
export interface Cost {
	name: CostName;
	median_ms: number;
	/** Median over the rounds of its time over that of the base in the same round. */
	ratio: number;
}

/** How one method's frames get longer from one size of model to another, measured in the same rounds. */
export interface Growth {
	method: Method;
	from: number;
	to: number;
	ratio: number;
}

export interface Point extends Row {
	median_ms: number;
}

export interface BenchFigures {
	/** The browser's own word on what draws. */
	device: string;
	browser: string;
	/** Of the processor, as the browser tells. */
	cores: number;
	/** What ends a frame: `readPixels` of one pixel, or the time that a query of the GPU tells. */
	clock: 'readPixels' | 'timer query';
	rounds: number;
	/** That the whole run took. */
	seconds: number;
	results: Result[];
	/** The same where the numbers of triangles are the sums over all 16 layers. */
	results_of_layers: Result[];
	growth: Growth[];
	/** Of the PTM with 4 608 triangles: what else fur can have, each by itself and all together. */
	costs: Cost[];
	/** Of the PTM with 4 608 triangles: what lights and fins cost. */
	lights: Cost[];
	/** Frames against the number of shells and against the size of the picture. */
	curves: { shells: Point[]; pixels: Point[] };
}

/** The article's Table 1, and the same measured here: frames per second with one number of triangles. */
export interface Table1Row {
	/** Of the body, as it is measured here; each of 16 shells has as many. */
	triangles: number;
	layered: { fps: number };
	ptm: { fps: number };
	/** How many times faster the PTM is; as measured here the median over rounds of turns there and back. */
	ratio: number;
}

/** What the article has, on a Quadro NVS 110 with 64 MB. */
export const ARTICLE: readonly Table1Row[] = [
	{ triangles: 512, layered: { fps: 41.6 }, ptm: { fps: 57.3 }, ratio: 57.3 / 41.6 },
	{ triangles: 4608, layered: { fps: 14.3 }, ptm: { fps: 17.4 }, ratio: 17.4 / 14.3 },
	{ triangles: 16896, layered: { fps: 5.7 }, ptm: { fps: 7.7 }, ratio: 7.7 / 5.7 },
];
