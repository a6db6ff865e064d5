/** Picture behind the model: an environment's panorama out of focus, and the ground that goes with it. */

import {
	Color,
	DataTexture,
	DataUtils,
	EquirectangularReflectionMapping,
	HalfFloatType,
	type LightProbe,
	LinearFilter,
	MathUtils,
	Object3D,
	RepeatWrapping,
	RGBAFormat,
	Vector3,
} from 'three';
import { luminance, visitEnvironment } from '../fur/reference.ts';

/** Largest width of the picture, texels. */
const MAX_WIDTH = 512;
/** Standard deviation of the blur, degrees: a lens that is focused on the model. */
const BLUR = 1.1;
/** Brightness of the picture over the panorama's light: the eye rests on the model. */
const DIMMED = 0.5;
/** Largest radiance of the picture: lamps blur into pale discs, not into half of the sky. */
const MAX_RADIANCE = 6;
/** Directions to the ground around the model, as sines of their depth below the horizon. */
const [NEAR_HORIZON, BELOW] = [0.05, 0.5];
/** Range of the ground's albedo. */
const [MIN_ALBEDO, MAX_ALBEDO] = [0.01, 0.5];

/** Texels of a picture. */
interface Size {
	width: number;
	height: number;
}

/**
 * Background for `scene.background`: the panorama through a lens that is focused on the model, dimmed.
 *
 * @param panorama four floats a texel; @param scale from its radiance to the page's
 */
export function blurred(panorama: DataTexture, scale: number): DataTexture {
	const shrink = Math.ceil(panorama.image.width / MAX_WIDTH);
	const size = { width: Math.ceil(panorama.image.width / shrink), height: Math.ceil(panorama.image.height / shrink) };
	const { width, height } = size;
	const cells = new Float32Array(4 * width * height);
	visitEnvironment(panorama, (radiance, to, solidAngle) => {
		const row = Math.min(Math.floor((Math.asin(MathUtils.clamp(to.y, -1, 1)) / Math.PI + 0.5) * height), height - 1);
		const column = Math.floor((Math.atan2(to.z, to.x) / (2 * Math.PI) + 0.5) * width) % width;
		const at = 4 * (row * width + column);
		const light = scale * DIMMED * solidAngle;
		const values = [radiance.r * light, radiance.g * light, radiance.b * light, solidAngle];
		for (const [c, value] of values.entries()) cells[at + c] = (cells[at + c] ?? 0) + value;
	});
	for (let at = 0; at < cells.length; at += 4) {
		const weight = cells[at + 3] || 1;
		const brightest = Math.max(cells[at] ?? 0, cells[at + 1] ?? 0, cells[at + 2] ?? 0) / weight;
		const kept = Math.min(1, MAX_RADIANCE / brightest) / weight;
		for (let c = 0; c < 3; c++) cells[at + c] = (cells[at + c] ?? 0) * kept;
		cells[at + 3] = 1;
	}
	// Half floats, which every GPU filters.
	const texels = Uint16Array.from(blurRows(blurColumns(cells, size), size), DataUtils.toHalfFloat);
	const picture = new DataTexture(texels, width, height, RGBAFormat, HalfFloatType);
	picture.mapping = EquirectangularReflectionMapping;
	picture.minFilter = picture.magFilter = LinearFilter;
	picture.wrapS = RepeatWrapping;
	picture.needsUpdate = true;
	return picture;
}

/** Weights of a Gaussian over the offsets -n to n. @param sigma in texels */
function gaussian(sigma: number, most: number): number[] {
	const reach = Math.min(Math.ceil(3 * sigma), most);
	const weights = Array.from({ length: 2 * reach + 1 }, (_, i) => Math.exp(-0.5 * ((i - reach) / sigma) ** 2));
	const sum = weights.reduce((total, weight) => total + weight, 0);
	return weights.map((weight) => weight / sum);
}

/** Sum of a kernel's texels. @param texel index of the texel at an offset */
function convolve(
	from: Float32Array,
	to: Float32Array,
	at: number,
	kernel: number[],
	texel: (offset: number) => number,
) {
	const reach = (kernel.length - 1) / 2;
	for (const [i, weight] of kernel.entries()) {
		const source = 4 * texel(i - reach);
		for (let c = 0; c < 4; c++) to[4 * at + c] = (to[4 * at + c] ?? 0) + weight * (from[source + c] ?? 0);
	}
}

function blurColumns(from: Float32Array, { width, height }: Size): Float32Array<ArrayBuffer> {
	const to = new Float32Array(from.length);
	const kernel = gaussian((BLUR / 180) * height, height);
	for (let row = 0; row < height; row++)
		for (let column = 0; column < width; column++)
			convolve(from, to, row * width + column, kernel, (offset) => {
				return MathUtils.clamp(row + offset, 0, height - 1) * width + column;
			});
	return to;
}

/** Blurs along the parallels, wider towards the poles. */
function blurRows(from: Float32Array, { width, height }: Size): Float32Array<ArrayBuffer> {
	const to = new Float32Array(from.length);
	for (let row = 0; row < height; row++) {
		const level = Math.cos(((row + 0.5) / height - 0.5) * Math.PI);
		const kernel = gaussian(((BLUR / 360) * width) / level, width / 2 - 1);
		for (let column = 0; column < width; column++)
			convolve(from, to, row * width + column, kernel, (offset) => row * width + ((column + offset + width) % width));
	}
	return to;
}

/**
 * Albedo of the ground that is as bright as the picture just below its horizon.
 *
 * @param picture as of `blurred`
 * @param probe light of everything but the lamp; @param lamp its colour times irradiance; @param direction to the lamp
 */
export function groundAlbedo(picture: DataTexture, probe: LightProbe, lamp: Color, direction: Vector3): Color {
	const seen = new Color(0, 0, 0);
	let weight = 0;
	visitEnvironment(picture, (radiance, to, solidAngle) => {
		if (-to.y < NEAR_HORIZON || -to.y > BELOW) return;
		seen.add(radiance.multiplyScalar(solidAngle));
		weight += solidAngle;
	});
	const light = probe.sh.getIrradianceAt(Object3D.DEFAULT_UP, new Vector3()).toArray();
	const whole = new Color(...light).add(lamp.clone().multiplyScalar(Math.max(direction.y, 0)));
	const albedo = seen.multiplyScalar(Math.PI / weight);
	for (const channel of ['r', 'g', 'b'] as const) albedo[channel] /= Math.max(whole[channel], 1e-3);
	const bright = luminance(albedo);
	return albedo.multiplyScalar(MathUtils.clamp(bright, MIN_ALBEDO, MAX_ALBEDO) / Math.max(bright, 1e-6));
}
