/**
 * Places whose light falls on the model: pictures of the light all around by Poly Haven (CC0), as packed in @pmndrs/assets.
 * Each is a file of its own that is fetched when it is wanted.
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
import { environmentLight, type Lamp, luminance, visitEnvironment } from '../fur/index.ts';
import { beforeNeutral } from '../page/backdrop.ts';

/** Their names in the address. */
export const environments = ['studio', 'city', 'sky', 'sunset', 'forest'] as const;

export type EnvironmentName = (typeof environments)[number];

export const isEnvironment = (name: string): name is EnvironmentName =>
	(environments as readonly string[]).includes(name);

const files: Record<EnvironmentName, () => Promise<{ default: string }>> = {
	studio: () => import('@pmndrs/assets/hdri/studio.exr.js'),
	city: () => import('@pmndrs/assets/hdri/city.exr.js'),
	sky: () => import('@pmndrs/assets/hdri/sky.exr.js'),
	sunset: () => import('@pmndrs/assets/hdri/sunset.exr.js'),
	forest: () => import('@pmndrs/assets/hdri/forest.exr.js'),
};

/** All light of an environment, radiance times solid angle: pictures of all places are as bright as those without one. */
const light = 13;

/** The lamp that one drags has at least this share of it, or dragging would do nothing. */
const keyShare = 0.35;

/** A place's light, in units of the page. */
export interface Environment {
	probe: LightProbe;
	/** The lamp to be dragged, where it stands in the picture; without a direction where the picture has no lamp. */
	key: { direction: Vector3 | undefined; colour: Color };
	/** Lamps beside it. */
	others: Lamp[];
	background: DataTexture;
}

/** @param azimuth radians about the upright axis from x towards z; where the place's sun is put, if it has one */
export async function loadEnvironment(name: EnvironmentName, azimuth: number): Promise<Environment> {
	const [{ default: file }, { EXRLoader }] = await Promise.all([
		files[name](),
		import('three/addons/loaders/EXRLoader.js'),
	]);
	const texture = await new EXRLoader().setDataType(FloatType).loadAsync(file);
	const [sun] = environmentLight(texture).lamps;
	if (sun) turn(texture, azimuth - Math.atan2(sun.direction.z, sun.direction.x));
	const { probe, lamps } = environmentLight(texture, 2);
	let whole = 0;
	visitEnvironment(texture, (radiance, _, solidAngle) => {
		whole += luminance(radiance) * solidAngle;
	});
	const scale = light / whole;
	for (const { colour } of lamps) colour.multiplyScalar(scale);
	for (const coefficient of probe.sh.coefficients) coefficient.multiplyScalar(scale);
	const [first, ...others] = lamps;
	const colour = first ? first.colour.clone() : new Color(1, 1, 1);
	colour.multiplyScalar(Math.max(1, (keyShare * light) / luminance(colour)));
	const background = blurred(texture);
	texture.dispose();
	return { probe, key: { direction: first?.direction, colour }, others, background };
}

/** Turns the picture about the upright axis, by whole columns. @param angle radians from x towards z */
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

/** The place out of focus and in the dark, so that the eye rests on the model. */
function blurred(texture: DataTexture, width = 96, height = 48): DataTexture {
	const sharpness = 70; // of exp(sharpness·(cos − 1)): a blur of about 7°
	const [darkest, brightness] = [0.012, 0.09]; // of nothing, and of what has the picture's mean
	// First into cells of about the blur's half, equal in size.
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
		// Deep shadows and lamps come nearer to the mean, and colours to grey.
		const here = luminance(colour);
		const shown = darkest + (brightness - darkest) * Math.min(Math.sqrt(here / mean), 1.6);
		colour.multiplyScalar((0.8 * shown) / here).addScalar(0.2 * shown);
		beforeNeutral(colour);
		texels.set([colour.r, colour.g, colour.b, 1], at);
		at += 4;
	});
	picture.mapping = EquirectangularReflectionMapping;
	picture.minFilter = picture.magFilter = LinearFilter;
	picture.wrapS = RepeatWrapping;
	picture.needsUpdate = true;
	return picture;
}
