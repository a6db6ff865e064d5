/**
 * Zip → files, for zips from anywhere.
 *
 * The directory is read and judged before anything is unpacked: names, sizes, passwords. fflate inflates, in pieces that
 * are counted. Why not a library's reader: fflate's takes the whole file into memory, does not tell encrypted entries from
 * broken ones and checks no checksum; that of `@zip.js/zip.js` (2.24) keeps the bounds, but is 37 kB gzipped at the least,
 * all that opens a model is 6.5 kB, and its errors do not tell a cut-off zip from no zip, or a zip without its beginning
 * from a damaged entry, which takes a look at these records anyway.
 *
 * Format: https://pkware.cachefly.net/webdocs/casestudies/APPNOTE.TXT, sections 4.3.7 (local header), 4.3.12 (directory)
 * and 4.3.16 (its end).
 */

import { Inflate } from 'fflate';
import { type Files, isIgnored, LIMITS, type Limits } from './files.ts';
import { Refused } from './refusal.ts';

const LOCAL = 0x04034b50;
const ENTRY = 0x02014b50;
const END = 0x06054b50;
/** Bytes of the three records without names and comments. */
const LOCAL_SIZE = 30;
const ENTRY_SIZE = 46;
const END_SIZE = 22;
const MAX_COMMENT = 0xffff;
/** Bytes of a directory's entry with its name, on average at most. */
const MAX_ENTRY_SIZE = 1024;
/**
 * Bytes inflated at once; deflate yields at most 1032 times as many. fflate 0.8.3 loses literals beyond 131 072 in a row, and
 * a literal takes one bit at least.
 */
const CHUNK = 16_383;

interface Entry {
	path: string;
	encrypted: boolean;
	method: number;
	crc: number;
	/** Bytes in the zip; bytes unpacked. */
	packed: number;
	size: number;
	/** Offset of its local header. */
	offset: number;
}

/**
 * @throws Refused with what is wrong with the zip
 */
export async function unzip(zip: Blob, limits: Limits = LIMITS): Promise<Files> {
	if (zip.size > limits.zip) throw new Refused((words) => words.zipTooLarge(zip.size, limits.zip));
	const entries = await readDirectory(zip, limits);
	const wanted = judge(entries, limits);
	if (wanted.length === 0) throw new Refused((words) => words.emptyZip);
	const files: Files = new Map();
	for (const entry of wanted) files.set(entry.path, await unpack(zip, entry));
	return files;
}

async function view(blob: Blob, from: number, to: number): Promise<DataView> {
	return new DataView(await blob.slice(from, to).arrayBuffer());
}

async function readDirectory(zip: Blob, limits: Limits): Promise<Entry[]> {
	if (zip.size === 0) throw new Refused((words) => words.emptyFile);
	const start = Math.max(zip.size - END_SIZE - MAX_COMMENT, 0);
	const tail = await view(zip, start, zip.size);
	let end = tail.byteLength - END_SIZE;
	// Only the true one is followed by just its comment.
	while (
		end >= 0 &&
		!(tail.getUint32(end, true) === END && end + END_SIZE + tail.getUint16(end + 20, true) === tail.byteLength)
	)
		end--;
	if (end < 0) {
		const begun = zip.size >= 4 && (await view(zip, 0, 4)).getUint32(0, true) === LOCAL;
		throw new Refused((words) => (begun ? words.cutOff : words.noZip));
	}
	const count = tail.getUint16(end + 10, true);
	const size = tail.getUint32(end + 12, true);
	const offset = tail.getUint32(end + 16, true);
	if (count === 0xffff || size === 0xffffffff || offset === 0xffffffff) throw new Refused((words) => words.zip64);
	if (count > limits.files || size > limits.files * MAX_ENTRY_SIZE)
		throw new Refused((words) => words.tooMany(limits.files));
	if (offset + size !== start + end) throw new Refused((words) => words.badDirectory);

	const directory = await view(zip, offset, offset + size);
	const entries: Entry[] = [];
	let at = 0;
	while (at + ENTRY_SIZE <= size && directory.getUint32(at, true) === ENTRY) {
		const [name, extra, comment] = [28, 30, 32].map((field) => directory.getUint16(at + field, true)) as [
			number,
			number,
			number,
		];
		const next = at + ENTRY_SIZE + name + extra + comment;
		if (next > size) break;
		entries.push({
			path: decodeName(new Uint8Array(directory.buffer, at + ENTRY_SIZE, name)),
			encrypted: (directory.getUint16(at + 8, true) & 1) === 1,
			method: directory.getUint16(at + 10, true),
			crc: directory.getUint32(at + 16, true),
			packed: directory.getUint32(at + 20, true),
			size: directory.getUint32(at + 24, true),
			offset: directory.getUint32(at + 42, true),
		});
		at = next;
	}
	if (at !== size || entries.length !== count) throw new Refused((words) => words.badDirectory);
	return entries;
}

/** Decodes a name as UTF-8, with or without its flag; others are of an old code page, and no name that a model asks for. */
function decodeName(bytes: Uint8Array): string {
	try {
		return new TextDecoder('utf-8', { fatal: true })
			.decode(bytes)
			.normalize('NFC')
			.replace(/^(\.\/)+/, '');
	} catch {
		return new TextDecoder('latin1').decode(bytes);
	}
}

/** Files of the directory without systems' litter. Refuses the zip for any entry that is unsafe. */
function judge(entries: Entry[], limits: Limits): Entry[] {
	for (const { path } of entries) {
		if (isBadPath(path)) throw new Refused((words) => words.badPath(path));
		// Some packers on Windows write such a path, which is another file on every other system.
		if (path.includes('\\')) throw new Refused((words) => words.backslash(path));
	}
	const wanted = entries.filter(({ path }) => !path.endsWith('/') && !isIgnored(path));
	const seen = new Set<string>();
	for (const { path, encrypted, method } of wanted) {
		if (seen.has(path)) throw new Refused((words) => words.twice(path));
		seen.add(path);
		if (encrypted) throw new Refused((words) => words.encrypted(path));
		if (method !== 0 && method !== 8) throw new Refused((words) => words.method(path, method));
	}
	const sum = wanted.reduce((total, { size }) => total + size, 0);
	if (sum > limits.bytes) throw new Refused((words) => words.tooLarge(sum, limits.bytes));
	return wanted;
}

/** True for paths that are absolute, lead up or name a drive, by either separator: no packer writes them by itself. */
function isBadPath(path: string): boolean {
	return /^[/\\]|^[a-z]:|\0/i.test(path) || path.split(/[/\\]/).includes('..');
}

async function unpack(zip: Blob, { path, method, crc, packed, size, offset }: Entry): Promise<Blob> {
	const damaged = new Refused((words) => words.damaged(path));
	const header = await view(zip, offset, offset + LOCAL_SIZE);
	if (header.byteLength < LOCAL_SIZE || header.getUint32(0, true) !== LOCAL) throw damaged;
	const start = offset + LOCAL_SIZE + header.getUint16(26, true) + header.getUint16(28, true);
	if (start + packed > zip.size) throw damaged;

	const parts: Uint8Array<ArrayBuffer>[] = [];
	let got = 0;
	let sum = 0;
	// Output is counted: sizes in the directory are trusted for refusals only.
	const take = (bytes: Uint8Array) => {
		got += bytes.length;
		if (got > size) throw new Refused((words) => words.swollen(path, size));
		sum = crc32(bytes, sum);
		parts.push(bytes as Uint8Array<ArrayBuffer>);
	};
	const inflate = method === 8 ? new Inflate(take) : undefined;
	for (let at = 0; at < packed; at += CHUNK) {
		const last = at + CHUNK >= packed;
		const bytes = new Uint8Array(await zip.slice(start + at, start + Math.min(at + CHUNK, packed)).arrayBuffer());
		try {
			if (inflate) inflate.push(bytes, last);
			else take(bytes);
		} catch (error) {
			throw error instanceof Refused ? error : damaged;
		}
	}
	if (got !== size || sum !== crc) throw damaged;
	return new Blob(parts);
}

const crcTable = Uint32Array.from({ length: 256 }, (_, i) => {
	let value = i;
	for (let bit = 0; bit < 8; bit++) value = value & 1 ? (value >>> 1) ^ 0xedb88320 : value >>> 1;
	return value;
});

/** CRC-32 of these bytes after those before. */
export function crc32(bytes: Uint8Array, before = 0): number {
	let crc = ~before;
	for (const byte of bytes) crc = (crcTable[(crc ^ byte) & 255] as number) ^ (crc >>> 8);
	return ~crc >>> 0;
}
