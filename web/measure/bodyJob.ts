/** Jobs of `furbake verify --body` for a page. */

/** Eye and lamp of a picture. */
export interface BodyCell {
	name: string;
	/** Name of the eye. */
	view: string;
	/** World units. */
	eye: readonly [number, number, number];
	/** Unit vector towards the lamp, world axes. */
	lamp: readonly [number, number, number];
}

/** Job, written by `furbake verify --body`. */
export interface BodyJob {
	width: number;
	height: number;
	/** Vertical field of view, degrees. */
	fieldOfView: number;
	/** Target of every eye, and the radius of the skin around it, world units. */
	centre: readonly [number, number, number];
	radius: number;
	/** Irradiance of the lamp, across its rays. */
	irradiance: number;
	cells: readonly BodyCell[];
	/** Names of methods, with the suffix `-bare` for no shadow map. */
	methods: readonly string[];
	/** Strength of highlights and of light from behind; both 0 for baked light alone. */
	gloss?: number;
	backlight?: number;
	/** Whether pictures are red, green, blue and coverage in place of light and coverage. */
	coloured: boolean;
	/** Passes of the samples' own composite, in passes/NN beside the model; 0 for none. */
	passes: number;
	/** Value of a white texel of a pass, in the unit of L. */
	brightest: number;
}
