/** Figures passed from the page to the commands. */

/** Number of pixels, and of those that are at least half covered. */
export interface Coverage {
	pixels: number;
	without: number;
	fins: number;
}

export interface FinView {
	name: string;
	/** Outline: pixels that 64 shells cover at least half and the bare skin does not. */
	beside: Coverage;
	/** All pixels that 64 shells cover at least half, also where the body is in front of its fur. */
	all: Coverage;
	/** All other pixels: coverage here has made the outline thicker. */
	extra: Coverage;
	/** Pixels changed by fins on the bare skin and around it. */
	finPixels: number;
	/** Those farther than the fur's length from all pixels that 64 shells cover at least half. */
	outside: number;
}

export interface FinCost {
	shells: number;
	/** Medians, milliseconds a frame. */
	without: number;
	fins: number;
	/** Median over the rounds of the time with fins over that without. */
	ratio: number;
}

export interface FinFigures {
	width: number;
	height: number;
	/** Length of the fur in these pictures, pixels. */
	length: number;
	views: FinView[];
	costs: FinCost[];
}

/** Error of a frame with automatic shells, against 64 shells and 16 samples per pixel. */
export interface Quality {
	/** Distance over that at which the model fills the picture. */
	distance: number;
	/** Radians from the front to the model's left. */
	azimuth: number;
	/** Shells of the frame. */
	shells: number;
	/** PSNR in dB of displayed values over a mid grey. */
	psnr: number;
	/** Mean linear light over the reference's. */
	brightness: number;
	/** Pixels compared: those that the reference's fur covers at least half. */
	pixels: number;
}

/** Difference between two pictures over the pixels that fur covers at least half, all three channels. */
export interface Deviation {
	/** Root mean square, share of the other's mean. */
	rmse: number;
	/** Relative difference of the means. */
	bias: number;
}

export interface EnvironmentView {
	name: string;
	/** Pixels covered by fur. */
	pixels: number;
	/** Deviations by number of lamps taken out of the harmonics, from none on. */
	moments: Deviation[];
}

export interface EnvironmentFigures {
	width: number;
	height: number;
	shells: number;
	/** Lamps that stand for the environment in the reference. */
	lamps: number;
	/** Shares of all light in the lamps taken out, in their order. */
	shares: number[];
	views: EnvironmentView[];
}

export interface MotionCost {
	/** Fur without motion, asleep, or in the wind with springs on the CPU or the GPU. */
	mode: 'without' | 'asleep' | 'cpu' | 'gpu';
	/** Processor of the springs; null without springs. */
	processor: 'cpu' | 'gpu' | null;
	/** Median, milliseconds, springs included. */
	frame: number;
	/** Median over the rounds of its time over that without motion. */
	ratio: number;
	/** Script time of the springs: median and 95th percentile, milliseconds. */
	script: number;
	script95: number;
}

export interface MotionFigures {
	width: number;
	height: number;
	shells: number;
	/** Faces of the skin, where it is one mesh. */
	faces: number;
	follicles: number;
	costs: MotionCost[];
}

/** Cost of a character, measured by `npm run character`. */
export interface CharacterCost {
	mode: 'statue' | 'held' | 'moving' | 'springs';
	/** Milliseconds per frame. */
	frame: number;
	/** Frame time over the statue's. */
	ratio: number;
	/** Milliseconds of script per frame, of clip and springs. */
	script: number;
}

/** Figures of `npm run character`. */
export interface CharacterFigures {
	width: number;
	height: number;
	joints: number;
	costs: CharacterCost[];
}
