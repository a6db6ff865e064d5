/** The glTF extension `FUR_ptm_shells`: its shape, and the checks that a reader makes. Knows no three. */

import { Validator } from '@cfworker/json-schema';
import schema from '../../baker/furbake/asset/schema/FUR_ptm_shells.schema.json';

/** The extension's name in a glTF file. */
export const EXTENSION = 'FUR_ptm_shells';

/** The newest version that this reader knows; a higher major version shows the skin alone. */
export const VERSION = '2.0';

/** What the coefficients multiply: the paper's eq. (2), or weights of the smooth functions, a row per coefficient. */
export type Basis =
	| {
			/** Six products of the light's coordinates. */
			kind: 'ptm';
	  }
	| {
			/** Curves found for this very fur. */
			kind: 'eigen';
			/** Of the smooth functions that they are made of, 1 to 8. */
			degree: number;
			/** A row of weights per coefficient, one for each smooth function. */
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
	/** As of the pelt: two images of `width` × `height`, root on top. */
	planes: number[];
	/** As of the pelt, there where the pelt has one. */
	colour?: number;
	/** As of the pelt. */
	scale: number[];
	/** As of the pelt. */
	bias: number[];
	/** Its own, in the fin's frame. */
	basis: Basis;
	/** Harmonics in the fin's frame, over the half sphere around the normal; in 1.x only. */
	environment?: number[][];
}

/** How many knots a mean curve has along the height of the light. */
export const KNOTS = 17;

/** Radii of bodies, in lengths of their fur, for which mean curves are tabulated. */
export const RADII = [1, 4, 16] as const;

/**
 * Mean light of a slab over directions: Σ_q weights[q]·(even[q] + along[q]·(l·m)), m being the way that the fur leans.
 * Each is [curve][radius][knot].
 */
export interface Curves {
	/** The part that is the same at all azimuths. */
	even: number[][][];
	/** The part that changes with the light's share along m. */
	along: number[][][];
}

/** What share of the slabs' light has met several hairs, and how it follows their colour; all lists go by slab. */
export interface Multiple {
	/** ϖ of the hairs in the samples. */
	albedo: number;
	/** What 1, √lz and log₄ β count in the share x. */
	shares: number[][];
	/** ρ, by which orders of scattering shrink between white hairs. */
	ratio: number[];
	/** Share in what is seen from above in even light. */
	seen: number[];
	/** Mean of the texels' tint. */
	tint: number[];
	/** Mean colour of the hairs, linear, where there is a colour plane. */
	colour?: RGB[];
}

/** One state of the fur. */
export interface Pelt {
	/** Of the preset that it was baked by. */
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
	/** A row per slab, slab 0 first: weights of the mean curves; in 2.x only. */
	weights?: number[][];
	/** Colour of light that has met several hairs; where absent it is as of the samples' grey ones. */
	multiple?: Multiple;
	/** Its side view, where the asset has fins. */
	fin?: Fin;
	/** How wet this state of the fur is, 0 where absent, to 1: soaked. Of dirty ones 0. */
	wetness?: number;
	/** How dirty it is, 0 where absent, to 1. Its tint is then the share of mud in the texel's coverage. */
	dirt?: number;
	/** Length of the hairs in this state, share of the asset's length; 1 where absent. */
	length?: number;
	/** What the hairs' colour is multiplied by; 1 where absent. */
	shade?: number;
	/** What the strength of the highlights is multiplied by; 1 where absent. */
	gloss?: number;
	/** What their exponent is multiplied by; 1 where absent. */
	sharpness?: number;
}

/** The extension's object in a glTF file: the fur of one body. */
export interface FurAsset {
	/** Of the format, major and minor. */
	version: string;
	/** Index of the node of the body without fur. */
	skin: number;
	/** Index of the node that is drawn once per shell. */
	shells: number;
	/** Index of the node of quads on the edges. */
	fins?: number;
	/** What TEXCOORD_0 is multiplied by to be in tiles; 1 where absent. */
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
	/** What the coefficients of all pelts multiply. */
	basis: Basis;
	/** A row of 9 per coefficient: spherical harmonics of the radiance → light moments; in 1.x only. */
	environment?: number[][];
	/** Mean curves of all states; in 2.x only. */
	curves?: Curves;
	/** Per slab: mean displacement of the hairs at its middle, tile widths. */
	drift: [number, number][];
	/** Light on bent hairs: rows for 1, s and s², in each the weights of eight terms; where absent, of any fur. */
	bent?: number[][];
	/** Light that goes to an eye beside the hairs: rows for 1, s and s², in each the weights of twelve terms. */
	eye?: number[][];
	/** Light of a lamp beside the eye: how much more it is from above, what more of it from aside, and its width, radians. */
	surge?: [number, number, number];
	/** Linear colours along a hair: mix(root, tip, s^power). */
	ramp: {
		/** At the skin. */
		root: RGB;
		/** At the tips. */
		tip: RGB;
		/** At the tips there where the mesh's attributes lead over to it. */
		tip2: RGB;
		/** The exponent. */
		power: number;
	};
	/** One at least; the first, dry and clean, is worn. Others that are wet or dirty are states of the same hairs. */
	pelts: Pelt[];
	/** Linear colour of the dirt, where a state is dirty. */
	mud?: RGB;
}

const validator = new Validator(schema as object, '2020-12', false);

/**
 * Checks the extension's object and returns it typed.
 *
 * @returns undefined for a newer major version, which a reader leaves alone
 * @throws Error that says what is wrong
 */
export function parseFur(extension: unknown): FurAsset | undefined {
	const version = (extension as { version?: unknown } | null)?.version;
	if (typeof version === 'string' && Number.parseInt(version, 10) > Number.parseInt(VERSION, 10)) return undefined;
	const { valid, errors } = validator.validate(extension);
	if (!valid) {
		const { instanceLocation, error } = errors[errors.length - 1] ?? { instanceLocation: '#', error: 'unknown' };
		throw new Error(`${EXTENSION}${instanceLocation.slice(1)}: ${error}`);
	}
	const asset = extension as FurAsset;
	for (const [name, rows, wanted] of [
		['drift', asset.drift.length, asset.layers] satisfies Count,
		...curveCounts(asset),
		...lightCounts('', asset, asset.coefficients, asset.curves !== undefined),
		...asset.pelts.flatMap((pelt) => [
			...texelCounts(pelt.name, pelt, asset.coefficients),
			...(pelt.fin ? finCounts(`${pelt.name}.fin`, pelt.fin, asset.curves !== undefined) : []),
		]),
	]) {
		if (rows !== wanted) throw new Error(`${EXTENSION}/${name}: got ${rows} entries, expected ${wanted}`);
	}
	if (asset.basis.kind === 'eigen') {
		const terms = (asset.basis.degree + 1) ** 2 + 2;
		const odd = asset.basis.matrix.find((row) => row.length !== terms);
		if (odd) throw new Error(`${EXTENSION}/basis.matrix: got a row of ${odd.length} weights, expected ${terms}`);
	}
	checkStates(asset);
	return asset;
}

/** What states of one fur have in common, so that they can be mixed. */
function checkStates({ pelts, coefficients, mud }: FurAsset): void {
	const [first, ...others] = pelts as [Pelt, ...Pelt[]];
	const refuse = (where: string, got: unknown, expected: string) => {
		throw new Error(`${EXTENSION}/${where}: got ${got}, expected ${expected}`);
	};
	if (first.wetness || first.dirt)
		refuse(
			'pelts',
			`${first.name} first, wet ${first.wetness ?? 0}, dirty ${first.dirt ?? 0}`,
			'the dry and clean one',
		);
	for (const pelt of others.filter(({ wetness, dirt }) => wetness || dirt)) {
		const { name, wetness, dirt, fin } = pelt;
		const before = pelts.slice(0, pelts.indexOf(pelt));
		if (wetness && dirt) refuse(name, `wetness ${wetness} with dirt ${dirt}`, 'one of the two');
		if (wetness && before.some((other) => (other.wetness ?? 0) >= wetness))
			refuse(`${name}.wetness`, wetness, 'more than of the pelts before it');
		if (dirt && before.some((other) => other.dirt)) refuse(`${name}.dirt`, dirt, 'no second dirty pelt');
		if (dirt && !mud) refuse('mud', 'none', 'the colour of dirt');
		if (dirt && coefficients < 4) refuse('coefficients', coefficients, '4 or more of fur that is dirty');
		for (const [where, got, wanted] of [
			['scale', pelt.scale, first.scale],
			['bias', pelt.bias, first.bias],
			['fin.scale', fin?.scale, first.fin?.scale],
			['fin.bias', fin?.bias, first.fin?.bias],
			['fin.width', fin?.width, first.fin?.width],
			['fin.height', fin?.height, first.fin?.height],
			// What is under mud has no colour of its own.
			...(dirt ? [] : [['colour', pelt.colour !== undefined, first.colour !== undefined] as const]),
		] as const) {
			if (`${got}` !== `${wanted}`) refuse(`${name}.${where}`, got, `${wanted} as of ${first.name}`);
		}
	}
}

/** What is counted, how many there are, how many there have to be. */
type Count = [name: string, rows: number, wanted: number];

/** @param curved whether mean curves stand for the environment */
function lightCounts(
	prefix: string,
	{ basis, environment = [] }: Pick<Fin, 'basis' | 'environment'>,
	wanted: number,
	curved: boolean,
): Count[] {
	return [
		[`${prefix}environment`, environment.length, curved ? 0 : wanted],
		[`${prefix}basis.matrix`, basis.kind === 'eigen' ? basis.matrix.length : 6, wanted],
	];
}

/** Tables of the curves, and the weights of every pelt. */
function curveCounts({ version, curves, pelts, layers }: FurAsset): Count[] {
	const count = curves?.even.length ?? 0;
	return [
		['curves', curves ? 1 : 0, Number.parseInt(version, 10) > 1 ? 1 : 0],
		['curves.along', curves?.along.length ?? 0, count],
		...Object.entries(curves ?? {}).flatMap(([name, tables]) =>
			(tables as number[][][]).flatMap((table, q): Count[] => [
				[`curves.${name}.${q}`, table.length, RADII.length],
				...table.map((knots, b): Count => [`curves.${name}.${q}.${b}`, knots.length, KNOTS]),
			]),
		),
		...pelts.flatMap(({ name, weights = [], multiple }): Count[] => [
			[`${name}.weights`, weights.length, curves ? layers : 0],
			[`${name}.multiple`, multiple ? 1 : 0, curves && pelts[0]?.multiple ? 1 : 0],
			...Object.entries(multiple ?? {}).flatMap(([key, rows]): Count[] =>
				Array.isArray(rows) ? [[`${name}.multiple.${key}`, rows.length, layers]] : [],
			),
			...weights.map((row, k): Count => [`${name}.weights.${k}`, row.length, count]),
		]),
	];
}

function texelCounts(name: string, { scale, bias, planes }: Omit<Pelt, 'name'>, coefficients: number): Count[] {
	return [
		[`${name}.scale`, scale.length, coefficients],
		[`${name}.bias`, bias.length, coefficients],
		[`${name}.planes`, planes.length, coefficients > 3 ? 2 : 1],
	];
}

/** A fin has six coefficients, of whatever number the pelt's own basis is. */
function finCounts(name: string, fin: Fin, curved: boolean): Count[] {
	return [...lightCounts(`${name}.`, fin, 6, curved), ...texelCounts(name, fin, 6)];
}

/** Where a number of a texel is stored. */
export interface Slot {
	/** 0 or 1: which of the planes. */
	plane: number;
	/** 0 to 3: R, G, B, A. */
	channel: number;
}

/** Where coefficient `i` is stored. */
export function channelOf(i: number): Slot {
	if (i < 3) return { plane: 0, channel: i };
	return i === 5 ? { plane: 0, channel: 3 } : { plane: 1, channel: i - 3 };
}

/** Where the coverage α is stored. */
export function alphaChannel(coefficients: number): Slot {
	return coefficients > 3 ? { plane: 1, channel: 2 } : { plane: 0, channel: 3 };
}
