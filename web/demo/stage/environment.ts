/**
 * Environments whose light falls on the model: panoramas by Poly Haven (CC0), as packed in @pmndrs/assets. Each is a file
 * of its own, fetched on demand.
 */

import {
	Color,
	DataTexture,
	EquirectangularReflectionMapping,
	FloatType,
	type LightProbe,
	LinearFilter,
	RepeatWrapping,
	RGBAFormat,
	Vector3,
} from 'three';
import { type FurLamp, furEnvironment } from '../../fur/index.ts';
import { luminance, visitEnvironment } from '../../fur/reference.ts';
import type { EnvironmentName } from '../state/view.ts';

const FILES: Record<EnvironmentName, () => Promise<{ default: string }>> = {
	studio: () => import('@pmndrs/assets/hdri/studio.exr.js'),
	city: () => import('@pmndrs/assets/hdri/city.exr.js'),
	sky: () => import('@pmndrs/assets/hdri/sky.exr.js'),
	sunset: () => import('@pmndrs/assets/hdri/sunset.exr.js'),
	forest: () => import('@pmndrs/assets/hdri/forest.exr.js'),
};

/** Total light of every environment, radiance times solid angle: as bright as the page's own sky. */
const TOTAL_LIGHT = 9.75;

/** Least share of the dragged lamp in the total light: dragging has to be seen. */
const MIN_KEY_SHARE = 0.35;

/** Light of an environment, in units of the page. */
export interface Environment {
	probe: LightProbe;
	/** The dragged lamp; its direction is undefined for a panorama without lamps. */
	key: { direction: Vector3 | undefined; colour: Color };
	/** Further lamps. */
	others: FurLamp[];
	background: DataTexture;
}

/** @param azimuth of the environment's sun, if any: radians about the upright axis from x towards z */
export async function loadEnvironment(name: EnvironmentName, azimuth: number): Promise<Environment> {
	const [{ default: file }, { EXRLoader }] = await Promise.all([
		FILES[name](),
		import('three/addons/loaders/EXRLoader.js'),
	]);
	const texture = await new EXRLoader().setDataType(FloatType).loadAsync(file);
	const [sun] = furEnvironment(texture).lamps;
	if (sun) turn(texture, azimuth - Math.atan2(sun.direction.z, sun.direction.x));
	const { probe, lamps } = furEnvironment(texture, 2);
	let whole = 0;
	visitEnvironment(texture, (radiance, _, solidAngle) => {
		whole += luminance(radiance) * solidAngle;
	});
	const scale = TOTAL_LIGHT / whole;
	for (const { colour } of lamps) colour.multiplyScalar(scale);
	for (const coefficient of probe.sh.coefficients) coefficient.multiplyScalar(scale);
	const [first, ...others] = lamps;
	const colour = first ? first.colour.clone() : new Color(1, 1, 1);
	colour.multiplyScalar(Math.max(1, (MIN_KEY_SHARE * TOTAL_LIGHT) / luminance(colour)));
	const background = blurred(texture);
	texture.dispose();
	return { probe, key: { direction: first?.direction, colour }, others, background };
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

/** Background: the panorama out of focus and dark, so that the eye rests on the model. */
function blurred(texture: DataTexture, width = 96, height = 48): DataTexture {
	const sharpness = 70; // in exp(sharpness·(cos − 1)): a blur of about 7°
	const [darkest, brightness] = [0.012, 0.09]; // at no light, and at the panorama's mean
	// First into cells of equal size, about half of the blur.
	const [rows, columns] = [48, 96];
	const cells = Array.from({ length: rows * columns }, () => ({
		light: new Color(0, 0, 0),
		to: new Vector3(),
		weight: 0,
	}));
	let mean = 0;
	visitEnvironment(texture, (radiance, to, solidAngle) => {
		const row = Math.min(Math.floor((to.y / 2 + 0.5) * rows), rows - 1);
		const column = Math.floor((Math.atan2(to.z, to.x) / (2 * Math.PI) + 1) * columns) % columns;
		const cell = cells[row * columns + column];
		if (!cell) return;
		cell.light.add(radiance.multiplyScalar(solidAngle));
		cell.to.addScaledVector(to, solidAngle);
		cell.weight += solidAngle;
		mean += luminance(radiance) / (4 * Math.PI);
	});
	for (const { to } of cells) to.normalize();
	const texels = new Float32Array(4 * width * height);
	const picture = new DataTexture(texels, width, height, RGBAFormat, FloatType);
	const colour = new Color();
	let at = 0;
	visitEnvironment(picture, (_, to) => {
		let weight = 0;
		colour.setRGB(0, 0, 0);
		for (const cell of cells) {
			const cosine = cell.to.dot(to);
			if (cosine < 0.93) continue;
			const share = Math.exp(sharpness * (cosine - 1));
			weight += share * cell.weight;
			colour.r += share * cell.light.r;
			colour.g += share * cell.light.g;
			colour.b += share * cell.light.b;
		}
		colour.multiplyScalar(1 / weight);
		// Shadows and lamps are drawn towards the mean, colours towards grey.
		const here = luminance(colour);
		const shown = darkest + (brightness - darkest) * Math.min(Math.sqrt(here / mean), 1.6);
		colour.multiplyScalar((0.8 * shown) / here).addScalar(0.2 * shown);
		texels.set([colour.r, colour.g, colour.b, 1], at);
		at += 4;
	});
	picture.mapping = EquirectangularReflectionMapping;
	picture.minFilter = picture.magFilter = LinearFilter;
	picture.wrapS = RepeatWrapping;
	picture.needsUpdate = true;
	return picture;
}
