/**
 * PNG → pixels, of 8 bits per channel. The browser inflates, beside the page's own work, and what comes is counted: a
 * library's reader (fast-png 8) inflates without bound, in the page's way, and is 5 kB gzipped.
 *
 * Format: https://www.w3.org/TR/png-3/, sections 8 (interlacing), 9 (filters) and 11.2 (chunks).
 */

/** Bytes of signature and header. */
const HEADER = 33;
/** Channels by colour type. */
const CHANNELS: Record<number, number> = { 0: 1, 2: 3, 3: 1, 4: 2, 6: 4 };
/** First column and row, steps to the right and down, of the picture or of the seven of an interlaced one. */
const WHOLE = [[0, 0, 1, 1]] as const;
const INTERLACED = [
	[0, 0, 8, 8],
	[4, 0, 8, 8],
	[0, 4, 4, 8],
	[2, 0, 4, 4],
	[0, 2, 2, 4],
	[1, 0, 2, 2],
	[0, 1, 1, 2],
] as const;

/** Header of a PNG. */
export interface PngHeader {
	width: number;
	height: number;
	/** Bits per channel. */
	depth: number;
	/** Channels as stored: a palette's index is one. */
	channels: number;
	interlaced: boolean;
}

interface Chunk {
	type: string;
	/** The data alone. */
	data: Uint8Array;
}

/** Chunks in order, as far as they are whole. */
function* chunks(png: Uint8Array): Generator<Chunk> {
	const view = new DataView(png.buffer, png.byteOffset, png.byteLength);
	let at = 8;
	while (at + 12 <= png.length) {
		const end = at + 8 + view.getUint32(at);
		if (end + 4 > png.length) return;
		const type = String.fromCharCode(...png.subarray(at + 4, at + 8));
		yield { type, data: png.subarray(at + 8, end) };
		at = end + 4;
	}
}

/** Header; undefined if it is no PNG. */
export function pngHeader(png: Uint8Array): PngHeader | undefined {
	const view = new DataView(png.buffer, png.byteOffset, png.byteLength);
	if (png.length < HEADER || view.getUint32(0) !== 0x89504e47) return undefined;
	const [depth = 0, type = 0, , , interlace] = png.subarray(24);
	return {
		width: view.getUint32(16),
		height: view.getUint32(20),
		depth,
		channels: CHANNELS[type] ?? 0,
		interlaced: interlace !== 0,
	};
}

/** False for a PNG without its end, and for less than any PNG has. */
export function isWholePng(png: Uint8Array): boolean {
	if (png.length >= HEADER && !pngHeader(png)) return true;
	for (const { type } of chunks(png)) if (type === 'IEND') return true;
	return false;
}

/**
 * Channels of all pixels, row after row.
 *
 * @param png with 8 bits per channel
 * @param header as from `pngHeader`; its size is trusted
 * @throws Error where the data is broken, or of another length than the header says
 */
export async function decodePng(
	png: Uint8Array,
	{ width, height, channels, interlaced }: PngHeader,
): Promise<Uint8Array> {
	const pictures = (interlaced ? INTERLACED : WHOLE)
		.map(([x, y, right, down]) => {
			const [columns, rows] = [Math.ceil((width - x) / right), Math.ceil((height - y) / down)];
			return { x, y, right, down, rows, bytes: columns * channels };
		})
		.filter(({ bytes, rows }) => bytes > 0 && rows > 0);
	// Rows begin with the number of their filter.
	const raw = await inflated(
		png,
		pictures.reduce((sum, { rows, bytes }) => sum + rows * (1 + bytes), 0),
	);
	const pixels = new Uint8Array(width * height * channels);
	let from = 0;
	for (const { x, y, right, down, rows, bytes } of pictures) {
		let above = new Uint8Array(bytes);
		for (let row = 0; row < rows; row++, from += 1 + bytes) {
			const line = raw.subarray(from + 1, from + 1 + bytes);
			unfilter(line, above, raw[from] as number, channels);
			const first = ((y + row * down) * width + x) * channels;
			if (right === 1) pixels.set(line, first);
			else
				for (let i = 0; i < bytes; i++)
					pixels[first + i + Math.floor(i / channels) * (right - 1) * channels] = line[i] as number;
			above = line;
		}
	}
	return pixels;
}

/** Undoes a row's filter, in place. @param above the row above, without its filter */
function unfilter(line: Uint8Array, above: Uint8Array, filter: number, channels: number): void {
	if (filter > 4) throw new Error(`got filter ${filter}, expected 0 to 4`);
	if (filter === 0) return;
	for (let i = 0; i < line.length; i++) {
		const left = i < channels ? 0 : (line[i - channels] as number);
		const up = above[i] as number;
		const corner = i < channels ? 0 : (above[i - channels] as number);
		const guess = filter === 1 ? left : filter === 2 ? up : filter === 3 ? (left + up) >> 1 : paeth(left, up, corner);
		line[i] = (line[i] as number) + guess;
	}
}

/** The nearest of the three to left + up − corner. */
function paeth(left: number, up: number, corner: number): number {
	const toLeft = Math.abs(up - corner);
	const toUp = Math.abs(left - corner);
	const toCorner = Math.abs(left + up - 2 * corner);
	if (toLeft <= toUp && toLeft <= toCorner) return left;
	return toUp <= toCorner ? up : corner;
}

/** Data of all IDAT chunks, inflated. @throws Error for more or less than `size` bytes */
async function inflated(png: Uint8Array, size: number): Promise<Uint8Array<ArrayBuffer>> {
	const data = [...chunks(png)].flatMap(({ type, data }) => (type === 'IDAT' ? [data as Uint8Array<ArrayBuffer>] : []));
	const raw = new Uint8Array(size);
	const more = new Error(`it unpacks to more than the ${size} bytes of its size`);
	let got = 0;
	const count = new WritableStream<Uint8Array>({
		write(bytes) {
			if (got + bytes.length > size) throw more;
			raw.set(bytes, got);
			got += bytes.length;
		},
	});
	let broken = false;
	try {
		await new Blob(data).stream().pipeThrough(new DecompressionStream('deflate')).pipeTo(count);
	} catch (error) {
		if (error === more) throw more;
		// Each browser says it in its own words.
		broken = true;
	}
	if (got < size) throw new Error(`got ${got} bytes of data, expected ${size}`);
	if (broken) throw new Error('its data or their checksum are broken');
	return raw;
}
