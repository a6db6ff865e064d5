/** Places in a few kilobytes: their light as numbers, and a small picture. Runs when the module is built. */

import { type DataTexture, DataUtils, FloatType } from 'three';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';
import { DEFAULT_LIGHT } from '../../page/light.ts';
import { type EnvironmentName, environmentOf, PANORAMAS } from '../../scene/environment.ts';
import { BRIGHTEST, HEIGHT, type PackedPlace, WIDTH } from './format.ts';

const rounded = (numbers: readonly number[]) => numbers.map((number) => Number(number.toPrecision(4)));

/** The panorama of a place, four floats a texel. */
export async function panorama(name: EnvironmentName): Promise<DataTexture> {
	const { default: address } = await PANORAMAS[name]();
	const bytes = Uint8Array.from(atob(address.slice(address.indexOf(',') + 1)), (letter) => letter.charCodeAt(0));
	return new EXRLoader().setDataType(FloatType).createDataTexture(bytes.buffer);
}

/** Packs all places, by name. */
export async function packPlaces(): Promise<Record<EnvironmentName, PackedPlace>> {
	const names = Object.keys(PANORAMAS) as EnvironmentName[];
	const packed = await Promise.all(names.map(async (name) => [name, pack(await panorama(name))] as const));
	return Object.fromEntries(packed) as Record<EnvironmentName, PackedPlace>;
}

function pack(texture: DataTexture): PackedPlace {
	const [x, , z] = DEFAULT_LIGHT;
	const { probe, key, others, background, ground } = environmentOf(texture, Math.atan2(z, x));
	return {
		probe: rounded(probe.sh.toArray()),
		...(key.direction && { direction: rounded(key.direction.toArray()) }),
		colour: rounded(key.colour.toArray()),
		others: others.map(({ direction, color }) => ({
			direction: rounded(direction.toArray()),
			colour: rounded(color.toArray()),
		})),
		ground: rounded(ground.toArray()),
		picture: btoa(String.fromCharCode(...shrunk(background))),
	};
}

/** Means of a picture's cells, as bytes. */
function shrunk({ image }: DataTexture): Uint8Array {
	const { width, height, data } = image as { width: number; height: number; data: Uint16Array };
	const sums = new Float64Array(4 * WIDTH * HEIGHT);
	for (let y = 0; y < height; y++)
		for (let x = 0; x < width; x++) {
			const cell = 4 * (Math.floor((y * HEIGHT) / height) * WIDTH + Math.floor((x * WIDTH) / width));
			for (let c = 0; c < 3; c++)
				sums[cell + c] = (sums[cell + c] as number) + DataUtils.fromHalfFloat(data[4 * (y * width + x) + c] as number);
			sums[cell + 3] = (sums[cell + 3] as number) + 1;
		}
	return Uint8Array.from({ length: 3 * WIDTH * HEIGHT }, (_, i) => {
		const cell = 4 * Math.floor(i / 3);
		const radiance = (sums[cell + (i % 3)] as number) / (sums[cell + 3] as number);
		return Math.round(255 * Math.sqrt(Math.min(radiance / BRIGHTEST, 1)));
	});
}
