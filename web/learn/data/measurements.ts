/** Measurements for the lesson, written by `furbake lesson`: `lesson/lesson.json` and the pictures beside it. */

import { decode } from 'fast-png';
import { alphaChannel, channelOf, type Direction, type Slot } from '../../fur/reference.ts';

/** Decibels over held-out lights, of all layers and of the view from above. */
export interface Figures {
	psnr: number;
	psnr_composite: number;
}

export interface ByNumbers extends Figures {
	numbers: number;
	/** Decibels of every layer; null without hair. */
	layers?: (number | null)[];
}

export interface ByBits extends Figures {
	bits: number;
	/** Decibels of the rounded numbers against the unrounded ones. */
	noise: number;
	layers: (number | null)[];
}

export interface LessonRecord {
	options: { layers: number; size: number };
	/** Lights of the fit, then those held out, then an arc over the tile along v. */
	lights: Direction[];
	fitted: number;
	held_out: number;
	/** Angles of the arc's lights from upright, degrees. */
	angles: number[];
	/** Singular values of the matrix of eq. (2), falling. */
	singular_values: number[];
	/** Terms of eq. (2), the most useful first. */
	terms: number[];
	eigen: { degree: number; matrix: number[][] };
	/** λ and Ω of the stored bytes. */
	scale: number[];
	bias: number[];
	/** L that counts as 1 in decibels. */
	peak: number;
	/** Fit as in the models' `bake.json`. */
	fit: {
		psnr: number;
		psnr_quantised: number;
		psnr_quantisation: number;
		bound: { rank: number; psnr: number };
	};
	layers: { psnr: (number | null)[]; psnr_quantised: (number | null)[] };
	ptm: ByNumbers[];
	eigen_figures: ByNumbers[];
	bound: ByNumbers[];
	bits: ByBits[];
	samples: { layer: number; file: string; texels: number; scale: number }[];
	planes: string[];
}

/** One layer of fur as measured, and the bytes that are stored for it. */
export interface Layer {
	/** Number counted from the skin. */
	readonly number: number;
	/** Texels per side. */
	readonly size: number;
	/** Coverage as stored, a byte per texel. */
	readonly alpha: Uint8Array;
	/** Texels with hair, row after row; row 0 is v = 0. */
	readonly texels: Int32Array;
	/** Index of every texel among those with hair, or -1. */
	readonly place: Int32Array;
	/** L: a row per light, a column per texel with hair. */
	readonly light: Float32Array;
	/** Six stored bytes of every texel with hair. */
	readonly codes: Uint8Array;
}

/** Places of a0 to a5, and of α. */
const SLOTS = [0, 1, 2, 3, 4, 5].map(channelOf);
const ALPHA = alphaChannel(6);

/**
 * @param index of the layer among those that were kept
 * @param samples its picture, PNG of 16 bits
 * @param planes planes stored bytes of all kept layers, PNG
 * @throws Error if they don't match
 */
export function decodeLayer(
	record: LessonRecord,
	index: number,
	samples: Uint8Array,
	planes: readonly Uint8Array[],
): Layer {
	const entry = record.samples[index];
	if (!entry) throw new Error(`layer ${index}: got ${record.samples.length} layers`);
	const { size } = record.options;
	const stored = planes.map((plane) => decode(plane));
	const first = index * size * size;
	const byte = (texel: number, { plane, channel }: Slot) => stored[plane]?.data[(first + texel) * 4 + channel] ?? 0;

	const alpha = Uint8Array.from({ length: size * size }, (_, texel) => byte(texel, ALPHA));
	const texels = Int32Array.from([...alpha.keys()].filter((texel) => alpha[texel]));
	const place = new Int32Array(alpha.length).fill(-1);
	texels.forEach((texel, i) => {
		place[texel] = i;
	});
	const picture = decode(samples);
	const { lights } = record;
	if (texels.length !== entry.texels || picture.width !== texels.length || picture.height !== lights.length)
		throw new Error(
			`${entry.file}: got ${picture.width} × ${picture.height}, expected ${texels.length} × ${lights.length}`,
		);
	return {
		number: entry.layer,
		size,
		alpha,
		texels,
		place,
		light: Float32Array.from(picture.data, (value) => value * entry.scale),
		codes: Uint8Array.from({ length: texels.length * 6 }, (_, i) =>
			byte(texels[Math.floor(i / 6)] ?? 0, SLOTS[i % 6] ?? ALPHA),
		),
	};
}

async function fetched(name: string): Promise<Response> {
	const response = await fetch(new URL(`lesson/${name}`, document.baseURI));
	if (!response.ok) throw new Error(`lesson/${name}: got status ${response.status}`);
	return response;
}

const bytes = async (name: string) => new Uint8Array(await (await fetched(name)).arrayBuffer());

/** Measurements of the lesson. Each file is fetched once, on first use; a failed one is retried. */
export class Measurements {
	readonly #files = new Map<string, Promise<Uint8Array>>();
	readonly #layers = new Map<number, Layer>();

	private constructor(readonly record: LessonRecord) {}

	static async open(): Promise<Measurements> {
		return new Measurements(await (await fetched('lesson.json')).json());
	}

	/** @param index of the layer among those that were kept */
	async layer(index: number): Promise<Layer> {
		const { samples, planes } = this.record;
		const files = [samples[index]?.file ?? '', ...planes].map((name) => this.#file(name));
		const [picture, ...stored] = await Promise.all(files);
		const layer = this.#layers.get(index) ?? decodeLayer(this.record, index, picture ?? new Uint8Array(), stored);
		this.#layers.set(index, layer);
		return layer;
	}

	#file(name: string): Promise<Uint8Array> {
		const file = this.#files.get(name) ?? bytes(name);
		this.#files.set(name, file);
		file.catch(() => this.#files.delete(name));
		return file;
	}
}
