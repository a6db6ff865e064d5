/** PNG planes → texture arrays, byte for byte, with mip levels that keep what the alpha cut lets through. */

import { decode } from 'fast-png';
import {
	type ColorSpace,
	CompressedArrayTexture,
	LinearFilter,
	LinearMipmapLinearFilter,
	NoColorSpace,
	RepeatWrapping,
	RGBAFormat,
	SRGBColorSpace,
	UnsignedByteType,
} from 'three';
import { alphaChannel } from './format.ts';

/** Texels of `layers` squares of `size` × `size`, RGBA, layer after layer. */
export type Texels = Uint8Array<ArrayBuffer>;

/**
 * The texels of a plane. The decoder is our own dependency, not the browser's: an image element multiplies RGB by A on
 * some of its ways to the GPU, and texels with α = 0 would lose their coefficients.
 *
 * @throws Error where the picture is not `size` wide, `size · layers` high, 8 bits, RGB or RGBA
 */
export function decodePlane(name: string, png: Uint8Array, size: number, layers: number): Texels {
	let image: ReturnType<typeof decode>;
	try {
		image = decode(png);
	} catch (error) {
		throw new Error(`${name}: not a readable PNG (${(error as Error).message})`);
	}
	const { width, height, channels, depth, data } = image;
	if (width !== size || height !== size * layers) {
		throw new Error(`${name}: got ${width} × ${height} pixels, expected ${size} × ${size * layers}`);
	}
	if (depth !== 8 || channels < 3) {
		throw new Error(`${name}: got ${channels} channels of ${depth} bits, expected RGB or RGBA of 8`);
	}
	const texels = new Uint8Array(width * height * 4).fill(255);
	for (let i = 0; i < width * height; i++) {
		for (let c = 0; c < channels; c++) texels[i * 4 + c] = data[i * channels + c] as number;
	}
	return texels;
}

interface Level {
	size: number;
	/** Values 0..255, as floats so that errors don't add up from level to level. */
	planes: Float32Array[];
	/** Coverage 0..1 per texel. */
	alpha: Float32Array;
}

/**
 * Mip levels of all planes of a pelt together, level 0 first, as bytes.
 *
 * What belongs to hairs is averaged by coverage. Coverage itself is averaged, then scaled per layer so that the alpha
 * cut passes the same share of texels as at level 0: fur neither thins out nor fills up with distance.
 */
export function mipLevels(
	planes: Texels[],
	size: number,
	layers: number,
	coefficients: number,
	cut: number,
): Texels[][] {
	const { plane: alphaPlane, channel } = alphaChannel(coefficients);
	const base = planes[alphaPlane] as Texels;
	const alpha = Float32Array.from({ length: base.length / 4 }, (_, i) => (base[i * 4 + channel] as number) / 255);
	const shares = Array.from({ length: layers }, (_, k) => shareAbove(layerOf(alpha, k, layers), cut));

	let level: Level = { size, planes: planes.map((plane) => Float32Array.from(plane)), alpha };
	const levels = [planes];
	while (level.size > 1) {
		level = halve(level, layers);
		const kept = level.alpha.slice();
		for (let k = 0; k < layers; k++) keepShare(layerOf(kept, k, layers), shares[k] as number, cut);
		levels.push(
			level.planes.map((plane, p) =>
				Uint8Array.from(plane, (value, i) =>
					Math.round(p === alphaPlane && i % 4 === channel ? (kept[i >> 2] as number) * 255 : value),
				),
			),
		);
	}
	return levels;
}

function layerOf(values: Float32Array, layer: number, layers: number): Float32Array {
	const length = values.length / layers;
	return values.subarray(layer * length, (layer + 1) * length);
}

function shareAbove(values: Float32Array, cut: number): number {
	return values.reduce((count, value) => count + (value > cut ? 1 : 0), 0) / values.length;
}

/** Scales values in place (at most threefold) so that a given share of them lies above the cut. */
function keepShare(values: Float32Array, share: number, cut: number): void {
	if (share <= 0 || share >= 1) return;
	const sorted = values.slice().sort();
	const quantile = sorted[Math.min(Math.floor((1 - share) * sorted.length), sorted.length - 1)] as number;
	const factor = Math.min(Math.max((cut * 1.001) / Math.max(quantile, 1e-3), 1), 3);
	for (let i = 0; i < values.length; i++) values[i] = Math.min((values[i] as number) * factor, 1);
}

function halve({ size, planes, alpha }: Level, layers: number): Level {
	const half = size / 2;
	const count = half * half * layers;
	const coarse: Level = {
		size: half,
		planes: planes.map(() => new Float32Array(count * 4)),
		alpha: new Float32Array(count),
	};
	const four = [0, 1, size, size + 1];
	for (let i = 0; i < count; i++) {
		const column = i % half;
		const row = (i - column) / half; // counts through all layers: their rows follow each other
		const first = row * 2 * size + column * 2;
		let total = 0;
		for (const step of four) {
			const weight = (alpha[first + step] as number) + 1e-4;
			total += weight;
			for (let p = 0; p < planes.length; p++) {
				const from = planes[p] as Float32Array;
				const to = coarse.planes[p] as Float32Array;
				for (let c = 0; c < 4; c++) {
					to[i * 4 + c] = (to[i * 4 + c] as number) + weight * (from[(first + step) * 4 + c] as number);
				}
			}
		}
		for (const plane of coarse.planes) for (let c = i * 4; c < i * 4 + 4; c++) plane[c] = (plane[c] as number) / total;
		coarse.alpha[i] = total / 4 - 1e-4;
	}
	return coarse;
}

/** A texture array of the given mip levels; tiles repeat. */
export function textureArray(
	name: string,
	mips: Texels[],
	size: number,
	layers: number,
	colour = false,
): CompressedArrayTexture {
	const colorSpace: ColorSpace = colour ? SRGBColorSpace : NoColorSpace;
	const levels = mips.map((data, i) => ({ data, width: size >> i, height: size >> i }));
	// Of three's array textures only this one takes mip levels that were made beforehand. Nothing is compressed.
	const texture = new CompressedArrayTexture(levels, size, size, layers, RGBAFormat as never, UnsignedByteType);
	texture.name = name;
	texture.colorSpace = colorSpace;
	texture.wrapS = texture.wrapT = RepeatWrapping;
	texture.magFilter = LinearFilter;
	texture.minFilter = LinearMipmapLinearFilter;
	texture.generateMipmaps = false;
	texture.needsUpdate = true;
	return texture;
}
