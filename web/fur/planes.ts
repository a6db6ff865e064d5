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

/** Texels of `layers` pictures of `width` × `height`, RGBA, layer after layer. */
export type Texels = Uint8Array<ArrayBuffer>;

/**
 * The texels of a plane. The decoder is our own dependency, not the browser's: an image element multiplies RGB by A on
 * some of its ways to the GPU, and texels with α = 0 would lose their coefficients.
 *
 * @throws Error where the picture is not `width` × `height`, 8 bits, RGB or RGBA
 */
export function decodePlane(name: string, png: Uint8Array, width: number, height: number): Texels {
	let image: ReturnType<typeof decode>;
	try {
		image = decode(png);
	} catch (error) {
		throw new Error(`${name}: not a readable PNG (${(error as Error).message})`);
	}
	const { channels, depth, data } = image;
	if (image.width !== width || image.height !== height) {
		throw new Error(`${name}: got ${image.width} × ${image.height} pixels, expected ${width} × ${height}`);
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

/** Texels of one layer, and layers. */
export interface Extent {
	width: number;
	height: number;
	layers: number;
}

interface Level {
	/** Texels of one layer. */
	width: number;
	height: number;
	/** Values 0..255, as floats so that errors don't add up from level to level. */
	planes: Float32Array[];
	/** Coverage 0..1 per texel. */
	alpha: Float32Array;
}

/**
 * Mip levels of all planes of a pelt together, level 0 first, as bytes.
 *
 * What belongs to hairs is averaged by coverage. Coverage itself is averaged, then scaled per layer so that the alpha
 * cut passes the same share of texels as at level 0: fur neither thins out nor fills up with distance. A cut of 0 lets
 * everything through and scales nothing.
 */
export function mipLevels(
	planes: Texels[],
	{ width, height, layers }: Extent,
	coefficients: number,
	cut: number,
): Texels[][] {
	const { plane: alphaPlane, channel } = alphaChannel(coefficients);
	const base = planes[alphaPlane] as Texels;
	const alpha = Float32Array.from({ length: base.length / 4 }, (_, i) => (base[i * 4 + channel] as number) / 255);
	const shares = Array.from({ length: layers }, (_, k) => shareAbove(layerOf(alpha, k, layers), cut));

	let level: Level = { width, height, planes: planes.map((plane) => Float32Array.from(plane)), alpha };
	const levels = [planes];
	while (level.width > 1 || level.height > 1) {
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

/** The next level: half as wide and half as high, rounded down, at least one texel. */
function halve({ width, height, planes, alpha }: Level, layers: number): Level {
	const [columns, rows] = [Math.max(width >> 1, 1), Math.max(height >> 1, 1)];
	const count = columns * rows * layers;
	const coarse: Level = {
		width: columns,
		height: rows,
		planes: planes.map(() => new Float32Array(count * 4)),
		alpha: new Float32Array(count),
	};
	const [right, down] = [width > 1 ? 1 : 0, height > 1 ? width : 0];
	const four = [0, right, down, right + down];
	for (let i = 0; i < count; i++) {
		const column = i % columns;
		const row = Math.floor(i / columns) % rows;
		const layer = Math.floor(i / (columns * rows));
		const first = (layer * height + row * 2) * width + column * 2;
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
	{ width, height, layers }: Extent,
	colour = false,
): CompressedArrayTexture {
	const colorSpace: ColorSpace = colour ? SRGBColorSpace : NoColorSpace;
	const levels = mips.map((data, i) => ({ data, width: Math.max(width >> i, 1), height: Math.max(height >> i, 1) }));
	// Of three's array textures only this one takes mip levels that were made beforehand. Nothing is compressed.
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
