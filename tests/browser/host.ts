/** A static host of the least kind: files below one folder, gzip, the headers of `_headers`, and a count of what goes out. */

import { readFileSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import type { AddressInfo } from 'node:net';
import { extname, join, normalize } from 'node:path';
import { gzipSync } from 'node:zlib';
import { headersFor, parseHeaders } from '../../web/tools/site/headers.mjs';

const types: Record<string, string> = {
	'.html': 'text/html; charset=utf-8',
	'.js': 'text/javascript',
	'.css': 'text/css',
	'.json': 'application/json',
	'.gltf': 'model/gltf+json',
	'.bin': 'application/octet-stream',
	'.svg': 'image/svg+xml',
	'.webmanifest': 'application/manifest+json',
	'.png': 'image/png',
	'.jpg': 'image/jpeg',
	'.woff2': 'font/woff2',
};
/** Packed already: hosts send them as they are. */
const packed = new Set(['.png', '.jpg', '.woff2']);

/** One answer. */
export interface Sent {
	/** below the site's root */
	path: string;
	/** of the body, over the wire */
	bytes: number;
	/** when the last of it was sent: milliseconds since 1970 */
	ended: number;
}

export interface Host {
	origin: string;
	/** where the site begins; ends in a slash */
	address: string;
	/** what has been sent, in the order in which it ended */
	sent: Sent[];
	close(): void;
}

/** @param folder of the address below which the files are found, with slashes at both ends */
export async function serveFolder(files: string, folder: string): Promise<Host> {
	const rules = parseHeaders(readFileSync(join(files, '_headers'), 'utf8'));
	const bodies = new Map<string, Buffer>();
	const sent: Sent[] = [];
	const find = (path: string) => {
		const file = join(files, normalize(path));
		return statSync(file, { throwIfNoEntry: false })?.isFile() ? file : undefined;
	};
	const server = createServer((request, response) => {
		const { pathname } = new URL(request.url ?? '/', 'http://localhost');
		const path = pathname.startsWith(folder) ? pathname.slice(folder.length - 1).replace(/\/$/, '/index.html') : '';
		const found = path && path !== '/_headers' ? find(path) : undefined;
		const file = found ?? join(files, '404.html');
		const type = extname(file);
		const zip = !packed.has(type);
		const raw = bodies.get(file) ?? (zip ? gzipSync(readFileSync(file)) : readFileSync(file));
		bodies.set(file, raw);
		response.writeHead(found ? 200 : 404, {
			...headersFor(rules, path || '/'),
			'content-type': types[type] ?? 'application/octet-stream',
			...(zip ? { 'content-encoding': 'gzip' } : {}),
		});
		response.on('finish', () => {
			sent.push({ path, bytes: raw.length, ended: performance.timeOrigin + performance.now() });
		});
		response.end(raw);
	});
	await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
	const origin = `http://127.0.0.1:${(server.address() as AddressInfo).port}`;
	return { origin, address: origin + folder, sent, close: () => server.close() };
}

export const weightOf = (files: readonly Sent[]) => files.reduce((sum, { bytes }) => sum + bytes, 0);
