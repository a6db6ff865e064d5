/** PNG planes → texture arrays, byte for byte, with mip levels that keep the light that they let through. */

import {
	type ColorSpace,
	CompressedArrayTexture,
	LinearFilter,
	LinearMipmapLinearFilter,
	LinearMipmapNearestFilter,
	NoColorSpace,
	RepeatWrapping,
	RGBAFormat,
	SRGBColorSpace,
	type Texture,
	UnsignedByteType,
} from 'three';
import { alphaChannel } from '../format.ts';
import { decodePng, pngHeader } from './png.ts';

/** PlaneBytes of `layers` pictures of `width` × `height`, RGBA, layer after layer. */
export type PlaneBytes = Uint8Array<ArrayBuffer>;

/**
 * Decodes a plane. The browser inflates and no more: an image element may multiply RGB by A on its way to
 * the GPU, and texels with α = 0 would lose their coefficients.
 *
 * @throws Error where the picture is not `width` × `height`, 8 bits, RGB or RGBA
 */
export async function decodePlane(name: string, png: Uint8Array, width: number, height: number): Promise<PlaneBytes> {
	const header = pngHeader(png);
	if (!header) throw new Error(`${name}: not a readable PNG (got ${png.length} bytes without a PNG's header)`);
	// Check the size before decoding: a few bytes may unpack to more than the memory.
	if (header.width !== width || header.height !== height)
		throw new Error(`${name}: got ${header.width} × ${header.height} pixels, expected ${width} × ${height}`);
	const { channels, depth } = header;
	if (depth !== 8 || channels < 3)
		throw new Error(`${name}: got ${channels} channels of ${depth} bits, expected RGB or RGBA of 8`);
	let data: Uint8Array;
	try {
		data = await decodePng(png, header);
	} catch (error) {
		throw new Error(`${name}: not a readable PNG (${(error as Error).message})`);
	}
	const texels = new Uint8Array(width * height * 4).fill(255);
	for (let i = 0; i < width * height; i++) {
		for (let c = 0; c < channels; c++) texels[i * 4 + c] = data[i * channels + c] as number;
	}
	return texels;
}

/** Size of a plane: texels of one layer, and layers. */
export interface Extent {
	width: number;
	height: number;
	layers: number;
}

interface MipLevel {
	/** PlaneBytes of one layer. */
	width: number;
	height: number;
	/** Values 0..255, means weighted by visibility; floats, so that rounding doesn't add up from level to level. */
	planes: Float32Array[];
	/** Coverage 0..1 per texel. */
	alpha: Float32Array;
	/** Light that reaches a texel, and the part that it stops; 0..1. */
	open: Float32Array;
	seen: Float32Array;
}

/** Directions of view averaged in mip levels: slopes along u and v, per height of the fur. */
const VIEW_SLOPES = [
	[0, 0],
	[0.7, 0],
	[-0.7, 0],
	[0, 0.7],
	[0, -0.7],
] as const;

/**
 * Mip levels of all planes of a pelt together, level 0 first, as bytes.
 *
 * A coarser texel stands for a bundle of hairs that partly hide each other from layer to layer; mean coverages would
 * composite as if they didn't. Its coverage keeps the transmitted light instead: the share that the bundle stops of the
 * light that reaches it. All other values are means weighted by visibility.
 *
 * @param rise height of the fur, widths of the tile
 */
export function mipLevels(planes: PlaneBytes[], extent: Extent, coefficients: number, rise: number): PlaneBytes[][] {
	const steps = mipSteps(planes, extent, coefficients, rise);
	let step = steps.next();
	while (!step.done) step = steps.next();
	return step.value;
}

/** `mipLevels` in steps of a few milliseconds. */
export function* mipSteps(
	planes: PlaneBytes[],
	{ width, height, layers }: Extent,
	coefficients: number,
	rise: number,
): Generator<void, PlaneBytes[][]> {
	const { plane: alphaPlane, channel } = alphaChannel(coefficients);
	const base = planes[alphaPlane] as PlaneBytes;
	const alpha = Float32Array.from({ length: base.length / 4 }, (_, i) => (base[i * 4 + channel] as number) / 255);
	const open = yield* openness(alpha, { width, height, layers }, rise);
	const seen = open.map((share, i) => share * (alpha[i] as number));

	let level: MipLevel = { width, height, planes: planes.map((plane) => Float32Array.from(plane)), alpha, open, seen };
	const levels = [planes];
	while (level.width > 1 || level.height > 1) {
		yield;
		level = halve(level, layers);
		yield;
		const { alpha: covered } = level;
		levels.push(
			level.planes.map((plane, p) =>
				Uint8Array.from(plane, (value, i) =>
					Math.round(p === alphaPlane && i % 4 === channel ? (covered[i >> 2] as number) * 255 : value),
				),
			),
		);
	}
	return levels;
}

/** Share of the light that reaches each texel, mean over the views. */
function* openness(
	alpha: Float32Array,
	{ width, height, layers }: Extent,
	rise: number,
): Generator<void, Float32Array> {
	const open = new Float32Array(alpha.length);
	const size = width * height;
	for (const [slopeU, slopeV] of VIEW_SLOPES) {
		yield;
		const shift = (slope: number, texels: number) => Math.round((slope * rise * texels) / layers);
		const [right, down] = [shift(slopeU, width), shift(slopeV, height)];
		let above = new Float32Array(size).fill(1);
		for (let k = layers - 1; k >= 0; k--) {
			const below = new Float32Array(size);
			for (let i = 0; i < size; i++) {
				const [column, row] = [(i % width) + right, Math.floor(i / width) + down];
				const from = ((row + height) % height) * width + ((column + width) % width);
				const share = k === layers - 1 ? 1 : (above[from] as number);
				open[k * size + i] = (open[k * size + i] as number) + share / VIEW_SLOPES.length;
				below[i] = share * (1 - (alpha[k * size + i] as number));
			}
			above = below;
		}
	}
	return open;
}

/** The next level: half as wide and half as high, rounded down, at least one texel. */
function halve({ width, height, planes, open, seen, alpha }: MipLevel, layers: number): MipLevel {
	const [columns, rows] = [Math.max(width >> 1, 1), Math.max(height >> 1, 1)];
	const count = columns * rows * layers;
	const coarse: MipLevel = {
		width: columns,
		height: rows,
		planes: planes.map(() => new Float32Array(count * 4)),
		alpha: new Float32Array(count),
		open: new Float32Array(count),
		seen: new Float32Array(count),
	};
	const [right, down] = [width > 1 ? 1 : 0, height > 1 ? width : 0];
	const four = [0, right, down, right + down];
	for (let i = 0; i < count; i++) {
		const column = i % columns;
		const row = Math.floor(i / columns) % rows;
		const layer = Math.floor(i / (columns * rows));
		const first = (layer * height + row * 2) * width + column * 2;
		let [total, stopped, came, covered] = [0, 0, 0, 0];
		for (const step of four) {
			const at = first + step;
			stopped += seen[at] as number;
			came += open[at] as number;
			covered += alpha[at] as number;
			// Hidden roots and empty texels count a little, to avoid division by 0.
			const weight = (seen[at] as number) + 1e-3 * (alpha[at] as number) + 1e-6;
			total += weight;
			for (let p = 0; p < planes.length; p++) {
				const from = planes[p] as Float32Array;
				const to = coarse.planes[p] as Float32Array;
				for (let c = 0; c < 4; c++) to[i * 4 + c] = (to[i * 4 + c] as number) + weight * (from[at * 4 + c] as number);
			}
		}
		for (const plane of coarse.planes) for (let c = i * 4; c < i * 4 + 4; c++) plane[c] = (plane[c] as number) / total;
		coarse.seen[i] = stopped / 4;
		coarse.open[i] = came / 4;
		coarse.alpha[i] = came > 4e-3 ? stopped / came : covered / 4;
	}
	return coarse;
}

/** A texture array of the given mip levels; tiles repeat. */
export function textureArray(
	name: string,
	mips: PlaneBytes[],
	{ width, height, layers }: Extent,
	colour = false,
): CompressedArrayTexture {
	const colorSpace: ColorSpace = colour ? SRGBColorSpace : NoColorSpace;
	const levels = mips.map((data, i) => ({ data, width: Math.max(width >> i, 1), height: Math.max(height >> i, 1) }));
	// The only array texture of three that takes precomputed mip levels. Nothing is compressed.
	const texture = new CompressedArrayTexture(levels, width, height, layers, RGBAFormat as never, UnsignedByteType);
	texture.name = name;
	texture.colorSpace = colorSpace;
	texture.wrapS = texture.wrapT = RepeatWrapping;
	texture.magFilter = LinearFilter;
	texture.minFilter = LinearMipmapLinearFilter;
	texture.generateMipmaps = false;
	texture.needsUpdate = true;
	return texture;
}

/**
 * Reads coefficients from the nearest mip level where another plane holds the coverage: the picture is the same to 56 dB, a
 * software rasteriser's frame costs .92, and a mixture of levels would only show in the outlines of hairs.
 */
export function readOneLevel({ plane0, plane1 }: Readonly<Record<string, Texture>>): void {
	if (plane0 && plane1) plane0.minFilter = LinearMipmapNearestFilter;
}
