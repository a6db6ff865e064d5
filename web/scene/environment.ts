/**
 * Environments whose light falls on the model: panoramas by Poly Haven (CC0), as packed in @pmndrs/assets. Each is a file
 * of its own, fetched on demand.
 */

import { Color, type DataTexture, FloatType, type LightProbe, MathUtils, Vector3 } from 'three';
import { type FurLamp, furEnvironment } from '../fur/index.ts';
import { luminance, visitEnvironment } from '../fur/reference.ts';
import { blurred, groundAlbedo } from './panorama.ts';

/** Modules of the panoramas' files, by name. */
export const PANORAMAS = {
	studio: () => import('@pmndrs/assets/hdri/studio.exr.js'),
	city: () => import('@pmndrs/assets/hdri/city.exr.js'),
	sky: () => import('@pmndrs/assets/hdri/sky.exr.js'),
	sunset: () => import('@pmndrs/assets/hdri/sunset.exr.js'),
	forest: () => import('@pmndrs/assets/hdri/forest.exr.js'),
} satisfies Record<string, () => Promise<{ default: string }>>;

/** Name of an environment. */
export type EnvironmentName = keyof typeof PANORAMAS;

/** Total light of every environment, radiance times solid angle: as bright as the page's own sky. */
const TOTAL_LIGHT = 9.75;

/** Least share of the dragged lamp in the total light: dragging has to be seen. */
const MIN_KEY_SHARE = 0.35;

/** Least share of what is no lamp: a photographer's fill, a tenth of the key light on the shaded side. */
const MIN_FILL_SHARE = 0.24;

/** Direction to a lamp where an environment has none: half way up. */
const OBLIQUE = new Vector3(1, 1, 1).normalize();

/** Light of an environment, in units of the page. */
export interface Environment {
	probe: LightProbe;
	/** The dragged lamp; its direction is undefined for a panorama without lamps. */
	key: { direction: Vector3 | undefined; colour: Color };
	/** Further lamps. */
	others: FurLamp[];
	background: DataTexture;
	/** Albedo of the ground. */
	ground: Color;
}

/** @param azimuth of the environment's sun, if any: radians about the upright axis from x towards z */
export async function loadEnvironment(name: EnvironmentName, azimuth: number): Promise<Environment> {
	const [{ default: file }, { EXRLoader }] = await Promise.all([
		PANORAMAS[name](),
		import('three/addons/loaders/EXRLoader.js'),
	]);
	const texture = await new EXRLoader().setDataType(FloatType).loadAsync(file);
	const environment = environmentOf(texture, azimuth);
	texture.dispose();
	return environment;
}

/**
 * Light and picture of a panorama, in units of the page.
 *
 * @param texture equirectangular, four floats a texel; it is turned
 * @param azimuth as of `loadEnvironment`
 */
export function environmentOf(texture: DataTexture, azimuth: number): Environment {
	const [sun] = furEnvironment(texture).lamps;
	if (sun) turn(texture, azimuth - Math.atan2(sun.direction.z, sun.direction.x));
	const { probe, lamps } = furEnvironment(texture, 2);
	let whole = 0;
	visitEnvironment(texture, (radiance, _, solidAngle) => {
		whole += luminance(radiance) * solidAngle;
	});
	const scale = TOTAL_LIGHT / whole;
	const fill = fillShare(probe, whole);
	const filled = Math.max(fill, MIN_FILL_SHARE);
	for (const { color } of lamps) color.multiplyScalar((scale * (1 - filled)) / (1 - fill));
	for (const coefficient of probe.sh.coefficients) coefficient.multiplyScalar((scale * filled) / fill);
	const [first, ...others] = lamps;
	const colour = first ? first.color.clone() : new Color(1, 1, 1);
	colour.multiplyScalar(Math.max(1, (MIN_KEY_SHARE * TOTAL_LIGHT) / luminance(colour)));
	const background = blurred(texture, scale);
	const ground = groundAlbedo(background, probe, colour, first?.direction ?? OBLIQUE);
	return { probe, key: { direction: first?.direction, colour }, others, background, ground };
}

/** Share of a probe in the whole light, within 0 and 1. @param whole radiance times solid angle */
function fillShare({ sh }: LightProbe, whole: number): number {
	const [{ x, y, z } = new Vector3()] = sh.coefficients;
	const light = luminance(new Color(x, y, z)) * 2 * Math.sqrt(Math.PI);
	return MathUtils.clamp(light / whole, 1e-3, 1 - 1e-3);
}

/** Turns the panorama about the upright axis, by whole columns. @param angle radians from x towards z */
function turn(texture: DataTexture, angle: number): void {
	const { data, width, height } = texture.image;
	const columns = Math.round((angle / (2 * Math.PI)) * width) + 2 * width;
	const row = new Float32Array(4 * width);
	for (let y = 0; y < height; y++) {
		const here = (data as Float32Array).subarray(4 * y * width, 4 * (y + 1) * width);
		row.set(here);
		for (let x = 0; x < width; x++) here.set(row.subarray(4 * x, 4 * x + 4), 4 * ((x + columns) % width));
	}
}
