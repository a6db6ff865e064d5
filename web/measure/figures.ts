/** What is measured, as the page hands it to the commands. */

/** Some pixels, and how many of them are at least half covered. */
export interface Coverage {
	pixels: number;
	without: number;
	fins: number;
}

export interface FinView {
	name: string;
	/** The outline: what 64 shells cover at least half and the bare skin does not. */
	beside: Coverage;
	/** All that 64 shells cover at least half, the body in front of its own fur too. */
	all: Coverage;
	/** All that 64 shells cover less: what is covered here has made the outline thicker. */
	extra: Coverage;
	/** Pixels that fins change on the bare skin and around it. */
	finPixels: number;
	/** Those of them that are farther than the fur's length from all that 64 shells cover at least half. */
	outside: number;
}

export interface FinCost {
	shells: number;
	/** Medians, milliseconds a frame. */
	without: number;
	fins: number;
	/** Median over the rounds of their time with fins over that without. */
	ratio: number;
}

export interface FinFigures {
	width: number;
	height: number;
	/** Of the fur in these pictures, pixels. */
	length: number;
	views: FinView[];
	costs: FinCost[];
}

/** A frame with as many shells as it needs, against 64 shells and 16 samples per pixel. */
export interface Quality {
	/** Units of that at which the model fills the picture. */
	distance: number;
	/** Radians from the front to the model's left. */
	azimuth: number;
	/** That the frame had. */
	shells: number;
	/** dB, of what a display shows over a mid grey. */
	psnr: number;
	/** Mean linear light over the reference's. */
	brightness: number;
	/** That were compared: those that the reference's fur covers at least half. */
	pixels: number;
}

/** How far a picture is from another, over the pixels that fur covers at least half, all three channels. */
export interface Deviation {
	/** root mean square, in shares of the other's mean */
	rmse: number;
	/** of the mean */
	bias: number;
}

export interface EnvironmentView {
	name: string;
	/** covered by fur */
	pixels: number;
	/** By number of lamps taken out of the harmonics, from none on. */
	moments: Deviation[];
}

export interface EnvironmentFigures {
	width: number;
	height: number;
	shells: number;
	/** That stand for the environment in the picture that the others are compared with. */
	lamps: number;
	/** Share of all light in the lamps that are taken out, in their order. */
	shares: number[];
	views: EnvironmentView[];
}

export interface MotionCost {
	/** Fur that knows nothing of motion, that sleeps, or that is in the wind with its springs on the CPU or the GPU. */
	mode: 'without' | 'asleep' | 'cpu' | 'gpu';
	/** What the springs ran on; null: there are none. */
	processor: 'cpu' | 'gpu' | null;
	/** Median, milliseconds, springs included. */
	frame: number;
	/** Median over the rounds of its time over that without motion. */
	ratio: number;
	/** What of it is the springs' script: median and 95th percentile, milliseconds. */
	script: number;
	script95: number;
}

export interface MotionFigures {
	width: number;
	height: number;
	shells: number;
	/** Of the skin, where it is one mesh. */
	faces: number;
	follicles: number;
	costs: MotionCost[];
}
