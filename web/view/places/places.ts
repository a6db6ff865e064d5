/** Places by name, unpacked. */

import {
	Color,
	DataTexture,
	DataUtils,
	EquirectangularReflectionMapping,
	HalfFloatType,
	LightProbe,
	LinearFilter,
	RepeatWrapping,
	RGBAFormat,
	Vector3,
} from 'three';
import type { Environment } from '../../scene/environment.ts';
import { BRIGHTEST, HEIGHT, type PackedPlace, WIDTH } from './format.ts';
import places from './table.json' with { type: 'json' };

const table: Readonly<Record<string, PackedPlace>> = places;

/** Texels of the background for each of the packed picture, per side. */
const FINER = 4;

/** @throws Error for a name of none */
export function placeNamed(name: string): Environment {
	const packed = Object.hasOwn(table, name) ? table[name] : undefined;
	if (!packed) throw new Error(`got ${name}, expected one of ${Object.keys(table).join(', ')}`);
	return unpack(packed);
}

/** Place of its packed form. */
export function unpack({ probe, direction, colour, others, ground, picture }: PackedPlace): Environment {
	const light = new LightProbe();
	light.sh.fromArray(probe);
	return {
		probe: light,
		key: { direction: direction && new Vector3().fromArray(direction), colour: new Color().fromArray(colour) },
		others: others.map((lamp) => ({
			direction: new Vector3().fromArray(lamp.direction),
			color: new Color().fromArray(lamp.colour),
		})),
		background: finer(Uint8Array.from(atob(picture), (letter) => letter.charCodeAt(0))),
		ground: new Color().fromArray(ground),
	};
}

/** Weights of four neighbours by the uniform cubic B-spline. @param share of the way from the second to the third */
function weights(share: number): number[] {
	const [a, b] = [1 - share, share];
	return [a ** 3 / 6, 2 / 3 - b * b + b ** 3 / 2, 2 / 3 - a * a + a ** 3 / 2, b ** 3 / 6];
}

/** Background of a small picture, without a corner in its gradients. */
function finer(bytes: Uint8Array): DataTexture {
	const [width, height] = [FINER * WIDTH, FINER * HEIGHT];
	const texels = new Uint16Array(4 * width * height);
	const one = DataUtils.toHalfFloat(1);
	for (let y = 0; y < height; y++) {
		const v = (y + 0.5) / FINER - 0.5;
		const rows = weights(v - Math.floor(v));
		for (let x = 0; x < width; x++) {
			const u = (x + 0.5) / FINER - 0.5;
			const columns = weights(u - Math.floor(u));
			const sums = [0, 0, 0];
			for (const [j, row] of rows.entries())
				for (const [i, column] of columns.entries()) {
					const [left, below] = [Math.floor(u) - 1 + i + WIDTH, Math.floor(v) - 1 + j];
					const at = 3 * (Math.min(Math.max(below, 0), HEIGHT - 1) * WIDTH + (left % WIDTH));
					for (let c = 0; c < 3; c++)
						sums[c] = (sums[c] as number) + row * column * ((bytes[at + c] as number) / 255) ** 2;
				}
			texels.set([...sums.map((sum) => DataUtils.toHalfFloat(BRIGHTEST * sum)), one], 4 * (y * width + x));
		}
	}
	const picture = new DataTexture(texels, width, height, RGBAFormat, HalfFloatType);
	picture.mapping = EquirectangularReflectionMapping;
	picture.minFilter = picture.magFilter = LinearFilter;
	picture.wrapS = RepeatWrapping;
	picture.needsUpdate = true;
	return picture;
}
