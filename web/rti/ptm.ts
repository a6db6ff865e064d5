/** PTM 1.2, the format of Malzbender and Gelb: lines of text, then bytes, the lowest row first. */

import { alike, type Decode, type Light, MAX_BYTES, type Plane, type Relit, RelitError } from './relit.ts';

/** Kinds that are read, and their bytes per pixel. */
const PLANES: Record<string, number> = { RGB: 18, LRGB: 9, JPEG_RGB: 18, JPEG_LRGB: 9 };
const TERMS = 6;
/** Bytes in which a header ends. */
const MAX_HEADER = 16384;
/** Size of an entry of the side information: number of a pixel, big end first, and its byte. */
const CORRECTION = 5;

/** The six functions of the polynomial. */
const terms = ([u, v]: Light): number[] => [u * u, v * v, u * v, u, v, 1];

/** Header word by word: writers differ in where its lines end. */
class Words {
	readonly #text: string;
	#at = 0;

	constructor(bytes: Uint8Array) {
		this.#text = String.fromCharCode(...bytes.subarray(0, MAX_HEADER));
	}

	word(): string {
		const found = /^\s*(\S{1,64})(?=\s)/.exec(this.#text.slice(this.#at, this.#at + 200));
		if (!found) throw new RelitError('header');
		this.#at += found[0].length;
		return found[1] as string;
	}

	numbers(count: number, whole = false): number[] {
		return Array.from({ length: count }, () => {
			const value = Number(this.word());
			if (!Number.isFinite(value) || (whole && !Number.isInteger(value))) throw new RelitError('header');
			return value;
		});
	}

	/** Where the pixels begin. */
	end(): number {
		const found = /^[ \t]*\r?\n/.exec(this.#text.slice(this.#at, this.#at + 200));
		if (!found) throw new RelitError('header');
		return this.#at + found[0].length;
	}
}

/** @param decode of the JPEG streams. @throws RelitError */
export async function parsePtm(bytes: Uint8Array, decode: Decode): Promise<Relit> {
	const words = new Words(bytes);
	const version = bytes.length > 0 ? words.word() : '';
	if (!/^PTM_/.test(version)) throw new RelitError('noPtm');
	const kind = words.word().replace('PTM_FORMAT_', '');
	const count = Object.hasOwn(PLANES, kind) ? (PLANES[kind] as number) : 0;
	if (!/^PTM_1\.[12]$/.test(version) || !count) throw new RelitError('ptmKind', `${version} ${kind}`);
	const [width = 0, height = 0] = words.numbers(2, true);
	if (width < 1 || height < 1) throw new RelitError('header');
	if (width * height * count > MAX_BYTES) throw new RelitError('large', `${width} × ${height}`);
	const [scale, bias] = [words.numbers(TERMS), words.numbers(TERMS)];
	const packed = kind.startsWith('JPEG') ? [words.word(), words.numbers(7 * count, true)] : undefined;
	const body = bytes.subarray(words.end());
	const planes = packed
		? await unpacked(body, packed[1] as number[], count, [width, height], decode)
		: plain(body, width * height, count, version === 'PTM_1.1');
	const many = count === 18 ? 3 : 1;
	return {
		...{ width, height, topDown: false },
		planes: planes.slice(0, TERMS * many),
		...(count === 9 && { colour: planes.slice(TERMS) }),
		scale: Array(many).fill(scale).flat(),
		bias: Array(many)
			.fill(bias.map((value) => value / 255))
			.flat(),
		weigh: count === 9 ? (light) => alike(terms(light)) : (light) => apart(terms(light)),
	};
}

/** Weights of three polynomials, a channel each. */
const apart = (functions: readonly number[]): number[] => [
	...[0, 0, 0],
	...[0, 1, 2].flatMap((own) => functions.flatMap((f) => [0, 1, 2].map((channel) => (channel === own ? f : 0)))),
];

/** Planes as they lie: six coefficients of each pixel together, once or three times, then the colours. */
function plain(body: Uint8Array, pixels: number, count: number, old: boolean): Plane[] {
	if (body.length < pixels * count) throw new RelitError('short');
	return Array.from({ length: count }, (_, plane) => {
		if (old && count === 9) return { data: body, stride: count, offset: plane };
		const block = Math.floor(plane / TERMS);
		const data = body.subarray(block * TERMS * pixels);
		return { data, stride: count === 9 && block === 1 ? 3 : TERMS, offset: plane - block * TERMS };
	});
}

/**
 * Planes of a grey JPEG each: most are differences to another one, plus 128, and wrap round at 256. What JPEG's own error
 * carries over that edge is corrected by side information.
 */
async function unpacked(
	body: Uint8Array,
	table: readonly number[],
	count: number,
	[width, height]: readonly [number, number],
	decode: Decode,
): Promise<Plane[]> {
	const rows = Array.from({ length: 7 }, (_, i) => table.slice(i * count, (i + 1) * count));
	const [transforms, across, down, order, references, sizes, sides] = rows as [number[], number[], ...number[][]] &
		number[][];
	const starts: number[] = [];
	let at = 0;
	for (let i = 0; i < count; i++) {
		const [size, side] = [sizes?.[i] ?? -1, sides?.[i] ?? -1];
		if (size < 0 || side < 0) throw new RelitError('header');
		starts.push(at);
		at += size + side;
	}
	if (at > body.length) throw new RelitError('short');
	const done: (Uint8Array | undefined)[] = Array(count).fill(undefined);
	const turn = [...done.keys()].sort((a, b) => (order?.[a] ?? 0) - (order?.[b] ?? 0) || a - b);
	for (const plane of turn) {
		const start = starts[plane] as number;
		const end = start + (sizes?.[plane] ?? 0);
		const grey = await greyOf(body.slice(start, end), width, height, plane, decode);
		const reference = references?.[plane] ?? -1;
		if (reference >= 0) {
			const other = done[reference];
			const transform = transforms[plane] ?? 0;
			const moved = transform & ~1 && (across[plane] || down?.[plane]);
			if (!other || moved) throw new RelitError('plane', `plane ${plane}`);
			for (let i = 0; i < grey.length; i++) {
				const base = other[i] as number;
				grey[i] = (grey[i] as number) + (transform & 1 ? 255 - base : base) - 128;
			}
		}
		correct(grey, body.subarray(end, end + (sides?.[plane] ?? 0)));
		done[plane] = grey;
	}
	return done.map((data) => ({ data: data as Uint8Array, stride: 1, offset: 0 }));
}

async function greyOf(stream: Uint8Array, width: number, height: number, plane: number, decode: Decode) {
	const found = await decode(new Blob([stream as BlobPart], { type: 'image/jpeg' })).catch(() => undefined);
	if (found?.width !== width || found.height !== height) throw new RelitError('plane', `plane ${plane}`);
	const grey = new Uint8Array(width * height);
	for (let i = 0; i < grey.length; i++) grey[i] = found.data[4 * i] as number;
	return grey;
}

function correct(grey: Uint8Array, side: Uint8Array): void {
	const view = new DataView(side.buffer, side.byteOffset, side.byteLength);
	for (let at = 0; at + CORRECTION <= side.length; at += CORRECTION) {
		const pixel = view.getUint32(at);
		if (pixel < grey.length) grey[pixel] = view.getUint8(at + 4);
	}
}
