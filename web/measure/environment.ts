/** Error of environment light by moments, against the same light from a thousand lamps. */

import {
	Color,
	type DataTexture,
	DirectionalLight,
	FloatType,
	type Light,
	PointLight,
	Vector3,
	WebGLRenderer,
} from 'three';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';
import { type FurLamp, furEnvironment } from '../fur/index.ts';
import { luminance, visitEnvironment } from '../fur/reference.ts';
import type { Deviation, EnvironmentFigures } from './figures.ts';
import { loadFur, Studio } from './studio.ts';

const VIEWS = [
	{ name: 'front', azimuth: 0, polar: Math.PI / 2 },
	{ name: 'behind, from above', azimuth: Math.PI, polar: Math.PI / 3 },
] as const;

/** Largest number of lamps taken out of the harmonics. */
const MAX_LAMPS = 2;

/** Distance of the lamps that stand for an environment, radii of the model: practically parallel light. */
const FAR = 1e4;

/** Lamps per frame, as many as shaders have room for. */
const AT_ONCE = 128;

/**
 * Lamps that stand for the picture: points spread evenly over the sphere (Fibonacci), each with the light of the texels
 * nearest to it, moved to their brightness-weighted middle.
 */
export function lampsOf(texture: DataTexture, count: number): FurLamp[] {
	const golden = Math.PI * (3 - Math.sqrt(5));
	const points = Array.from({ length: count }, (_, i) => {
		const y = 1 - (2 * i + 1) / count;
		const level = Math.sqrt(1 - y * y);
		return new Vector3(level * Math.cos(i * golden), y, level * Math.sin(i * golden));
	});
	const lamps = points.map(() => ({ direction: new Vector3(), color: new Color(0, 0, 0) }));
	// Bound of the search: no direction is farther than 4/√count from its point, and points are in order of y, 2/count apart.
	const reach = Math.ceil(2 * Math.sqrt(count));
	visitEnvironment(texture, (radiance, to, solidAngle) => {
		const level = Math.floor(((1 - to.y) / 2) * count);
		let [nearest, closest] = [0, -2];
		for (let i = Math.max(level - reach, 0); i <= Math.min(level + reach, count - 1); i++) {
			const cosine = points[i]?.dot(to) ?? -2;
			if (cosine > closest) [nearest, closest] = [i, cosine];
		}
		const lamp = lamps[nearest];
		lamp?.direction.addScaledVector(to, luminance(radiance) * solidAngle);
		lamp?.color.add(radiance.multiplyScalar(solidAngle));
	});
	return lamps.filter(({ direction }) => direction.normalize().lengthSq() > 0);
}

/** Deviation over the pixels that fur covers at least half. */
function deviation(picture: Float32Array, truth: Float32Array): Deviation & { pixels: number } {
	let [values, sum, whole, squares] = [0, 0, 0, 0];
	truth.forEach((wanted, i) => {
		if (i % 4 === 3 || (truth[i - (i % 4) + 3] ?? 0) < 0.5) return;
		const value = picture[i] ?? 0;
		values++;
		sum += value;
		whole += wanted;
		squares += (value - wanted) ** 2;
	});
	return { pixels: values / 3, rmse: Math.sqrt(squares / values) / (whole / values), bias: sum / whole - 1 };
}

const directional = ({ direction, color }: FurLamp) => {
	const light = new DirectionalLight(color);
	light.position.copy(direction);
	return light;
};

/**
 * Measures the fur alone in linear light: no tone mapping, no shadow, no highlight. Openness is left to the horizon, as it
 * is for lamps.
 *
 * @param model address of a model.gltf
 * @param picture equirectangular, or the address of an EXR
 */
export async function measureEnvironment(
	model: string,
	picture: string | DataTexture,
	{ width = 320, height = 240, shells = 16, lamps = 1024, views = VIEWS.length as number, fins = true } = {},
): Promise<EnvironmentFigures> {
	const fur = await loadFur(model);
	const texture =
		typeof picture === 'string' ? await new EXRLoader().setDataType(FloatType).loadAsync(picture) : picture;
	const renderer = new WebGLRenderer({ antialias: false });
	const studio = new Studio(renderer, fur, width, height);
	studio.showFurAlone();
	studio.showFur(shells, fins);
	for (const part of [fur.shells, fur.fins]) {
		const attribute = part?.geometry.getAttribute('_fur');
		for (let i = 0; i < (attribute?.count ?? 0); i++) attribute?.setZ(i, 1);
	}
	const draw = (...lights: Light[]) => {
		studio.light(...lights);
		return studio.draw();
	};

	// Far points instead of parallel lights, over which three unrolls its loop a thousand times.
	const many = lampsOf(texture, lamps).map(({ direction, color }) => {
		const lamp = new PointLight(color, 1, 0, 0);
		lamp.position.copy(direction).multiplyScalar(FAR * studio.radius);
		return lamp;
	});
	const frames = Math.ceil(many.length / AT_ONCE);
	// Lamps of each frame are spread all around, so that negative light is clamped in the sum, not per lamp.
	const groups = Array.from({ length: frames }, (_, frame) => many.filter((_, i) => i % frames === frame));
	const splits = Array.from({ length: MAX_LAMPS + 1 }, (_, most) => furEnvironment(texture, most));

	const measured = VIEWS.slice(0, views).map(({ name, azimuth, polar }) => {
		studio.look(azimuth, polar);
		const truth = new Float32Array(width * height * 4);
		for (const group of groups)
			draw(...group).forEach((value, i) => {
				truth[i] = i % 4 === 3 ? value : (truth[i] ?? 0) + value;
			});
		const moments = splits.map(({ probe, lamps: out }) => deviation(draw(probe, ...out.map(directional)), truth));
		return {
			name,
			pixels: moments[0]?.pixels ?? 0,
			moments: moments.map(({ rmse, bias }) => ({ rmse, bias })),
		};
	});
	const whole = many.reduce((sum, { color }) => sum + luminance(color), 0);
	const shares = splits.at(-1)?.lamps.map(({ color }) => luminance(color) / whole) ?? [];
	studio.dispose();
	renderer.dispose();
	texture.dispose();
	return { width, height, shells, lamps: many.length, shares, views: measured };
}
