/** What `furbake verify --body` wants to see of a page. */

/** An eye and a lamp. */
export interface BodyCell {
	name: string;
	/** Name of the eye. */
	view: string;
	/** World units. */
	eye: readonly [number, number, number];
	/** Unit vector towards the lamp, world axes. */
	lamp: readonly [number, number, number];
}

/** What is drawn; written by `furbake verify --body`. */
export interface BodyJob {
	width: number;
	height: number;
	/** Degrees, from the picture's lower to its upper edge. */
	fieldOfView: number;
	/** What every eye looks at, and the radius of the skin around it, world units. */
	centre: readonly [number, number, number];
	radius: number;
	/** Of the lamp, across its rays. */
	irradiance: number;
	cells: readonly BodyCell[];
	/** A method's name, with `-bare` after it where no shadow map is wanted. */
	methods: readonly string[];
	/** Of the fur's highlights, and of the light from behind: both 0 where only what was baked is to be seen. */
	gloss?: number;
	backlight?: number;
	/** Whether pictures are red, green and blue, then coverage, in place of light and coverage. */
	coloured: boolean;
	/** Of the samples' own composite, in passes/NN beside the model; 0: it is not drawn. */
	passes: number;
	/** What a white texel of a pass stands for, in the unit of L. */
	brightest: number;
}
