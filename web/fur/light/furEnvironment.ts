/** Light of an equirectangular picture: spherical harmonics, and lamps for what is too bright and narrow for them. */

import {
	Color,
	type DataTexture,
	DataUtils,
	FloatType,
	HalfFloatType,
	LightProbe,
	RGBAFormat,
	SphericalHarmonics3,
	Vector3,
} from 'three';

/**
 * Angular radius of the region gathered into one lamp. Fur is so blunt a mirror that a sun with its glare, or a soft box,
 * is a point to it. A smaller cone leaves the harmonics more than they can hold, a larger one moves the glare.
 */
const CONE = (20 * Math.PI) / 180;

/** Outer angular radius of the ring around `CONE` whose mean radiance replaces the lamp's. */
const RING = (30 * Math.PI) / 180;

/** Smallest share of all the light that makes a lamp. */
const MIN_LAMP_SHARE = 0.05;

/** Largest half float; replaces infinity. */
const MAX_RADIANCE = 65504;

/** Brightness of linear red, green and blue (ITU-R BT.709). */
const LUMINANCE = [0.2126, 0.7152, 0.0722] as const;

/** Light from one direction, for a `DirectionalLight`. */
export interface FurLamp {
	/** Unit vector to it, world axes. */
	direction: Vector3;
	/** Irradiance of a surface that faces it, linear: `DirectionalLight.color`. */
	color: Color;
}

/** Light of a place as three's own lights. */
export interface FurEnvironment {
	/** Spherical harmonics of the radiance to order 2, world axes, as three's own generator gives them. */
	probe: LightProbe;
	/** Lamps taken out of the probe, in the order found. */
	lamps: FurLamp[];
}

/** Callback per texel of an environment. @param direction unit vector to it, world axes; @param solidAngle its steradians; both reused */
export type Visit = (radiance: Color, direction: Vector3, solidAngle: number) => void;

/** Luminance of a linear colour. */
export const luminance = ({ r, g, b }: Color): number => LUMINANCE[0] * r + LUMINANCE[1] * g + LUMINANCE[2] * b;

/**
 * Visits the texels of an equirectangular picture, placed as three does: u = ½ + atan2(z, x)/2π, v = ½ + asin(y)/π.
 *
 * @param texture four floats or half floats a texel, as three's EXRLoader and HDRLoader give them; negative values and
 * NaN count as 0
 */
export function visitEnvironment(texture: DataTexture, visit: Visit): void {
	const { data, width = 0, height = 0 } = texture.image ?? {};
	const half = texture.type === HalfFloatType;
	const usable = data instanceof (half ? Uint16Array : Float32Array) && data.length === 4 * width * height;
	if (!usable || texture.format !== RGBAFormat || (!half && texture.type !== FloatType))
		throw new Error('environment: expected an equirectangular DataTexture of four floats or half floats a texel');
	const read = (i: number) => {
		const value = half ? DataUtils.fromHalfFloat(data[i] ?? 0) : (data[i] ?? 0);
		return value > 0 ? Math.min(value, MAX_RADIANCE) : 0;
	};
	const [radiance, direction] = [new Color(), new Vector3()];
	const turns = Array.from({ length: width }, (_, column) => ((column + 0.5) / width - 0.5) * 2 * Math.PI);
	const around = turns.map((angle) => [Math.cos(angle), Math.sin(angle)] as const);
	for (let row = 0; row < height; row++) {
		const fromNadir = texture.flipY ? height - 1 - row : row;
		const elevation = ((fromNadir + 0.5) / height - 0.5) * Math.PI;
		const step = Math.PI / height;
		const solidAngle = ((2 * Math.PI) / width) * 2 * Math.sin(step / 2) * Math.cos(elevation);
		const [y, level] = [Math.sin(elevation), Math.cos(elevation)];
		for (let column = 0; column < width; column++) {
			const at = 4 * (row * width + column);
			const [x = 1, z = 0] = around[column] ?? [];
			direction.set(level * x, y, level * z);
			radiance.setRGB(read(at), read(at + 1), read(at + 2));
			visit(radiance, direction, solidAngle);
		}
	}
}

function add(sum: Color, colour: Color, weight: number): void {
	sum.r += weight * colour.r;
	sum.g += weight * colour.g;
	sum.b += weight * colour.b;
}

const beyond = new Color();

/** Excess of a radiance over its surroundings, per channel; the result is reused. */
const above = (radiance: Color, around: Color) => beyond.copy(radiance).sub(around);

/** Region of the sky that becomes a lamp. */
interface Cone {
	/** unit vector */
	middle: Vector3;
	/** mean radiance of the ring */
	around: Color;
}

/** `visitEnvironment` with the excess of these cones removed. */
function visitWithout(texture: DataTexture, cones: readonly Cone[], visit: Visit): void {
	visitEnvironment(texture, (radiance, to, solidAngle) => {
		for (const { middle, around } of cones) if (to.dot(middle) > Math.cos(CONE)) radiance.sub(above(radiance, around));
		visit(radiance, to, solidAngle);
	});
}

/**
 * Light of the picture as harmonics and lamps; together they hold all of it.
 *
 * @param most largest number of lamps
 */
export function furEnvironment(texture: DataTexture, most = 1): FurEnvironment {
	const total = new Color(0, 0, 0);
	visitEnvironment(texture, (radiance, _, solidAngle) => add(total, radiance, solidAngle));
	const cones: Cone[] = [];
	const lamps: FurLamp[] = [];
	while (lamps.length < most) {
		const cone = brightestCone(texture, cones);
		const lamp = { direction: new Vector3(), color: new Color(0, 0, 0) };
		visitWithout(texture, cones, (radiance, to, solidAngle) => {
			if (to.dot(cone.middle) <= Math.cos(CONE)) return;
			const excess = above(radiance, cone.around);
			add(lamp.color, excess, solidAngle);
			lamp.direction.addScaledVector(to, luminance(excess) * solidAngle);
		});
		if (!(luminance(lamp.color) > MIN_LAMP_SHARE * luminance(total))) break;
		lamp.direction.normalize();
		cones.push(cone);
		lamps.push(lamp);
	}
	const harmonics = new SphericalHarmonics3();
	const basis = new Array<number>(9).fill(0);
	visitWithout(texture, cones, (radiance, to, solidAngle) => {
		SphericalHarmonics3.getBasisAt(to, basis);
		for (const [j, coefficient] of harmonics.coefficients.entries()) {
			const weight = (basis[j] ?? 0) * solidAngle;
			coefficient.x += weight * radiance.r;
			coefficient.y += weight * radiance.g;
			coefficient.z += weight * radiance.b;
		}
	});
	return { probe: new LightProbe(harmonics), lamps };
}

/** Cone around the centroid of the brightest of 1 152 equal patches of the sky. */
function brightestCone(texture: DataTexture, without: readonly Cone[]): Cone {
	const [rows, columns] = [24, 48];
	const patches = Array.from({ length: rows * columns }, () => ({ light: 0, middle: new Vector3() }));
	visitWithout(texture, without, (radiance, to, solidAngle) => {
		const row = Math.min(Math.floor(((to.y + 1) / 2) * rows), rows - 1);
		const column = Math.floor((Math.atan2(to.z, to.x) / (2 * Math.PI) + 1) * columns) % columns;
		const patch = patches[row * columns + column];
		if (!patch) return;
		const light = luminance(radiance) * solidAngle;
		patch.light += light;
		patch.middle.addScaledVector(to, light);
	});
	const brightest = patches.reduce((best, patch) => (patch.light > best.light ? patch : best));
	const cone = { middle: brightest.middle.normalize(), around: new Color(0, 0, 0) };
	for (let round = 0; round < 3; round++) {
		let seen = 0;
		const [ring, centre] = [new Color(0, 0, 0), new Vector3()];
		visitWithout(texture, without, (radiance, to, solidAngle) => {
			const cosine = to.dot(cone.middle);
			if (cosine <= Math.cos(RING)) return;
			if (cosine > Math.cos(CONE)) {
				centre.addScaledVector(to, luminance(radiance) * solidAngle);
			} else {
				add(ring, radiance, solidAngle);
				seen += solidAngle;
			}
		});
		if (seen > 0) cone.around.copy(ring).multiplyScalar(1 / seen);
		if (centre.lengthSq() > 0) cone.middle.copy(centre).normalize();
	}
	return cone;
}
