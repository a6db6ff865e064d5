/** Types of the glTF extension `FUR_ptm_shells`. */

/** Basis of the coefficients: the paper's eq. (2), or weighted sums of the smooth functions. */
export type Basis =
	| {
			/** Six products of the light's coordinates. */
			kind: 'ptm';
	  }
	| {
			/** Light curves found for this fur. */
			kind: 'eigen';
			/** Degree of the smooth functions, 1 to 8. */
			degree: number;
			/** A row per coefficient: weights of the smooth functions. */
			matrix: number[][];
	  };

/** A linear colour. */
export type RGB = [number, number, number];

/** The same fur cut from the side, for the fins. Its frame is (edge, normal, across): φ takes (l·edge, l·normal). */
export interface Fin {
	/** Texels along the edge, one tile. */
	width: number;
	/** Texels from skin to tip. */
	height: number;
	/** Image indices, as in `Pelt`: two images of `width` × `height`, root on top. */
	planes: number[];
	/** Index of an sRGB image, present where the pelt has one. */
	colour?: number;
	/** The paper's λ, per coefficient. */
	scale: number[];
	/** The paper's Ω, per coefficient. */
	bias: number[];
	/** Basis in the fin's frame. */
	basis: Basis;
	/** Harmonics in the fin's frame, over the half sphere around the normal; format 1.x only. */
	environment?: number[][];
}

/** Knots of a mean curve along the height of the light. */
export const KNOTS = 17;

/** Radii of bodies, in lengths of their fur, for which mean curves are tabulated. */
export const RADII = [1, 4, 16] as const;

/**
 * Mean light of a slab over directions: Σ_q weights[q]·(even[q] + along[q]·(l·m)), with m the direction of the fur's
 * lean. Tables are [curve][radius][knot].
 */
export interface Curves {
	/** Part that is equal at all azimuths. */
	even: number[][][];
	/** Part proportional to the light's component along m. */
	along: number[][][];
}

/** Share of light that has met several hairs, and its dependence on their colour; all lists go by slab. */
export interface Multiple {
	/** ϖ of the sampled hairs. */
	albedo: number;
	/** Weights of 1, √lz and 3·(β − 1)/(2·β + 1) in the share x. */
	shares: number[][];
	/** ρ, ratio of successive orders of scattering between white hairs. */
	ratio: number[];
	/** Share of the light seen from above under an even sky. */
	seen: number[];
	/** Mean of the texels' tint. */
	tint: number[];
	/** Mean colour of the hairs, linear, where there is a colour plane. */
	colour?: RGB[];
}

/** One state of the fur. */
export interface Pelt {
	/** Name of the state. */
	name: string;
	/** Indices of images: (a0, a1, a2, a5) and (a3, a4, α, tint); with three coefficients one image (a0, a1, a2, α). */
	planes: number[];
	/** Index of an sRGB image: the texel's original colour. */
	colour?: number;
	/** Index of an RGB image: the hairs' mean tangent from root to tip in T, B, N, each component 2·byte/255 − 1. */
	direction?: number;
	/** The paper's λ, per coefficient: a = λ(byte − Ω). */
	scale: number[];
	/** The paper's Ω. */
	bias: number[];
	/** A row per slab, slab 0 first: weights of the mean curves; format 2.x only. */
	weights?: number[][];
	/** Colour of light that has met several hairs; absent: that of the grey samples. */
	multiple?: Multiple;
	/** Side view, where the asset has fins. */
	fin?: Fin;
	/** Wetness of this state, 0 (also where absent) to 1: soaked. Dirty states have 0. */
	wetness?: number;
	/** Dirt of this state, 0 (also where absent) to 1. The tint is then the share of mud in the texel's coverage. */
	dirt?: number;
	/** Length of the hairs in this state, share of the asset's length; 1 where absent. */
	length?: number;
	/** Factor of the hairs' colour; 1 where absent. */
	shade?: number;
	/** Factor of the highlights' strength; 1 where absent. */
	gloss?: number;
	/** Factor of the highlights' exponent; 1 where absent. */
	sharpness?: number;
}

/** The extension's object in a glTF file: the fur of one body. */
export interface FurAsset {
	/** Version of the format, major and minor. */
	version: string;
	/** Index of the skin's node. */
	skin: number;
	/** Index of the shells' node. */
	shells: number;
	/** Index of the fins' node: quads on the edges. */
	fins?: number;
	/** Fins in place of that node; format 2.2, of a body with joints 2.3. */
	edges?: {
		/** Index of an accessor: a bit for each edge of the shells. */
		mask: number;
		/** Where the first fin begins, a share of a tile. */
		start: number;
	};
	/** Colours of the skin at the roots of the hairs; format 2.3. */
	roots?: {
		/** Index of a texture of the glTF, sRGB. */
		texture: number;
		/** Coordinates of the picture per tile. */
		scale: [number, number];
	};
	/** Factor from TEXCOORD_0 to tiles; 1 where absent. */
	tiles?: number;
	/** Slabs of the tile. */
	layers: number;
	/** Texels per side of the tile. */
	size: number;
	/** Numbers per texel, 3 to 6. */
	coefficients: number;
	/** Longest fur, the model's own units. */
	length: number;
	/** Longest fur, tile widths. */
	height: number;
	/** Basis of the coefficients of all pelts. */
	basis: Basis;
	/** A row of 9 per coefficient: spherical harmonics of the radiance → light moments; format 1.x only. */
	environment?: number[][];
	/** Mean curves of all states; format 2.x only. */
	curves?: Curves;
	/** Per slab: mean displacement of the hairs at its middle, tile widths. */
	drift: [number, number][];
	/** Light on bent hairs: rows for 1, s and s², in each the weights of eight terms; absent: weights for any fur. */
	bent?: number[][];
	/** Light seen from aside: rows for 1, s and s², in each the weights of sixteen terms, of which the last four may be missing. */
	eye?: number[][];
	/** The same for fins, which any eye sees as one on the horizon does; without it they go by `eye`. */
	finEye?: number[][];
	/** Surge of light of a lamp beside the eye: excess seen from above, further excess from aside, width in radians. */
	surge?: [number, number, number];
	/** Mean distance of the hairs' slopes from the mean slope at their height. */
	spread?: number;
	/** Share of the skin that is seen from straight above between the hairs; absent where that is next to nothing. */
	open?: number;
	/** Light on shorter hairs: weights of 1, s and s² in its growth with −ln of the share of their length; absent: none. */
	short?: [number, number, number];
	/** Linear colours along a hair: mix(root, tip, s^power). */
	ramp: {
		/** At the skin. */
		root: RGB;
		/** At the tips. */
		tip: RGB;
		/** Second colour of the tips, blended in by the mesh's attributes. */
		tip2: RGB;
		/** The exponent. */
		power: number;
	};
	/** States, one at least; the first is dry and clean. Wet and dirty ones are states of the same hairs. */
	pelts: Pelt[];
	/** Linear colour of the dirt, where a state is dirty. */
	mud?: RGB;
	/** Further furs on the same body; all else here is of the first one, the coat. Format 2.3. */
	regions?: {
		/** Width of a tile of the coat, model units. */
		tile: number;
		/** Cells along that width in which all hairs are of one fur. */
		cells: number;
		/** Furs beside the coat. */
		furs: RegionFur[];
	};
}

/** Fur of a region of a body; the rest is as of the coat. */
export interface RegionFur
	extends Pick<
		FurAsset,
		'height' | 'curves' | 'drift' | 'bent' | 'eye' | 'finEye' | 'surge' | 'spread' | 'open' | 'short' | 'ramp' | 'pelts'
	> {
	/** Name of the region. */
	name: string;
	/** Width of its tile over that of the coat's. */
	tile: number;
}

/** Place of a number of a texel. */
export interface Slot {
	/** Plane, 0 or 1. */
	plane: number;
	/** Channel, 0 to 3: R, G, B, A. */
	channel: number;
}
