/** Folders of relight and OpenLIME: `info.json`, and pictures of three planes each. */

import { hemispherical, lattice, polynomial, radial, spherical } from './bases.ts';
import {
	alike,
	type Decode,
	interleaved,
	type Light,
	MAX_BYTES,
	type Pixels,
	type Plane,
	type Relit,
	RelitError,
} from './relit.ts';

type Functions = (light: Light) => number[];

const FIXED: Record<string, { functions: Functions; most: number }> = {
	ptm: { functions: polynomial, most: 6 },
	hsh: { functions: hemispherical, most: 9 },
	sh: { functions: spherical, most: 9 },
};
const MAX_PLANES = 99;
const MAX_NUMBERS = 1e6;

/** Fields that are read; a file may hold anything in their place. */
type Info = Record<string, unknown>;

/**
 * @param text of `info.json`
 * @param file a file beside it by its name; undefined where there is none
 * @throws RelitError
 */
export async function parseRelight(
	text: string,
	file: (name: string) => Blob | undefined,
	decode: Decode,
): Promise<Relit> {
	let info: Info;
	try {
		info = JSON.parse(text);
	} catch {
		throw new RelitError('info');
	}
	if (typeof info !== 'object' || info === null) throw new RelitError('info');
	const space = String(info.colorspace);
	const chroma = space === 'mycc' ? numbers(info.yccplanes, 3) : [];
	const count = space === 'mycc' ? chroma.reduce((sum, part) => sum + part, 0) : info.nplanes;
	if (typeof count !== 'number' || !Number.isInteger(count) || count < 3 || count > MAX_PLANES)
		throw new RelitError('info');
	const material = (info.materials as Info[] | undefined)?.[0] ?? {};
	const [scale, bias] = [numbers(material.scale, count), numbers(material.bias, count)];
	const weigh = weighing(info, space, count, chroma, material);
	const suffix = info.format === 'png' ? 'png' : 'jpg';
	const pictures = await read(count, (i) => `plane_${i}.${suffix}`, file, decode);
	const { width, height } = pictures[0] as Pixels;
	const planes: Plane[] = Array.from({ length: count }, (_, i) => ({
		data: (pictures[Math.floor(i / 3)] as Pixels).data,
		stride: 4,
		offset: i % 3,
	}));
	const first = space === 'lrgb' ? 3 : 0;
	return {
		...{ width, height, topDown: true, weigh },
		planes: planes.slice(first),
		scale: scale.slice(first),
		bias: bias.slice(first),
		...(first && { colour: planes.slice(0, first) }),
	};
}

async function read(
	planes: number,
	nameOf: (index: number) => string,
	file: (name: string) => Blob | undefined,
	decode: Decode,
): Promise<Pixels[]> {
	const pictures: Pixels[] = [];
	for (let i = 0; i < Math.ceil(planes / 3); i++) {
		const blob = file(nameOf(i));
		const found = blob && (await decode(blob).catch(() => undefined));
		const first = pictures[0] ?? found;
		if (!found || found.width !== first?.width || found.height !== first.height)
			throw new RelitError('plane', nameOf(i));
		if ((found.width * found.height * 4 * planes) / 3 > MAX_BYTES)
			throw new RelitError('large', `${found.width} × ${found.height}`);
		pictures.push(found);
	}
	return pictures;
}

function weighing(info: Info, space: string, planes: number, chroma: number[], material: Info): Relit['weigh'] {
	const kind = String(info.type);
	const fixed = Object.hasOwn(FIXED, kind) ? FIXED[kind] : undefined;
	if (fixed && (space === 'lrgb' || space === 'rgb')) {
		const count = space === 'lrgb' ? planes - 3 : planes / 3;
		if (Number.isInteger(count) && count >= 1 && count <= fixed.most) {
			const spread = space === 'lrgb' ? alike : interleaved;
			return (light) => spread(fixed.functions(light).slice(0, count));
		}
	}
	if ((kind !== 'rbf' && kind !== 'bilinear') || (space !== 'mrgb' && space !== 'mycc'))
		throw new RelitError('relightKind', `${kind} ${space}`.slice(0, 40));
	const lamps = kind === 'rbf' ? numbers(info.lights) : [];
	const resolution = Number(info.resolution);
	const sigma = Number(info.sigma);
	const count = kind === 'rbf' ? lamps.length / 3 : resolution * resolution;
	const fits = kind === 'rbf' ? sigma > 1e-6 && Number.isInteger(count) : resolution >= 2 && resolution <= 100;
	if (!fits || count < 1) throw new RelitError('info');
	const shares: Functions =
		kind === 'rbf' ? (light) => radial(light, lamps, sigma) : (light) => lattice(light, resolution);
	const table = numbers(info.basis, (planes + 1) * count * 3);
	const ranges = numbers(material.range, planes);
	return (light) => {
		const share = shares(light);
		const mixed = Array.from({ length: 3 * (planes + 1) }, (_, i) => {
			const plane = Math.floor(i / 3);
			let sum = 0;
			share.forEach((weight, lamp) => {
				const stored = table[(plane * count + lamp) * 3 + (i % 3)] as number;
				sum += weight * (plane === 0 ? stored / 255 : (stored - 127) / (ranges[plane - 1] as number));
			});
			return sum;
		});
		return space === 'mrgb' ? mixed : fromYcc(mixed, chroma[1] as number);
	};
}

/** Weights for R, G and B of those for brightness and two differences of colour; these end after `pictures` pictures. */
function fromYcc(weights: readonly number[], pictures: number): number[] {
	return Array.from({ length: weights.length / 3 }, (_, row) => {
		const plane = row - 1;
		const only = row === 0 ? undefined : Math.floor(plane / 3) < pictures ? plane % 3 : 0;
		const [y = 0, red = 0, green = 0] = [0, 1, 2].map((channel) =>
			only === undefined || only === channel ? (weights[3 * row + channel] as number) : 0,
		);
		const blue = y - green / 2 - red / 2;
		return [blue + red, y + green / 2, blue];
	}).flat();
}

function numbers(value: unknown, count?: number): number[] {
	const sound = Array.isArray(value) && value.length <= MAX_NUMBERS && (count === undefined || value.length === count);
	if (!sound || !value.every((item) => Number.isFinite(item))) throw new RelitError('info');
	return value;
}
