/** Files that came without a server, and the model among them. Knows neither page nor zip. */

import { LoadingManager } from 'three';
import type { Source } from './models.ts';
import { Refused } from './refusal.ts';

/** By path, `/` between folders, in normal form C. */
export type Files = Map<string, Blob>;

/** How the files came: a missing one is told by that. */
export type Container = 'zip' | 'folder' | 'file';

export interface Limits {
	/** Bytes of a zip, and of all files unpacked. */
	zip: number;
	bytes: number;
	files: number;
}

/** Ten times what the heaviest preset bakes, and what a phone's memory takes. */
export const LIMITS: Limits = { zip: 100e6, bytes: 300e6, files: 1000 };

/** Folders above the model's own: a zip of a folder has one, a zip of a folder in its like named one two. */
const DEEPEST = 2;

/** A model whose files the page itself holds. */
export interface OwnSource extends Source {
	/** of the glTF file among them */
	path: string;
	/** Frees the addresses that were made for its files; none of them can be loaded any more. */
	release(): void;
}

/** What systems leave in folders. */
export function isIgnored(path: string): boolean {
	return path.split('/').some((name) => /^(\.|__MACOSX$|thumbs\.db$|desktop\.ini$)/i.test(name));
}

const depth = (path: string) => path.split('/').length - 1;
const fileName = (path: string) => path.split('/').at(-1) as string;

/**
 * The path of the one model: `model.gltf`, or else whatever glTF file there is, as high up as there is any.
 *
 * @throws Refused where there is none, or are several
 */
export function findModel(files: Files): string {
	const paths = [...files.keys()];
	for (const wanted of [/^model\.gltf$/i, /\.(gltf|glb)$/i]) {
		const found = paths.filter((path) => depth(path) <= DEEPEST && wanted.test(fileName(path)));
		const highest = Math.min(...found.map(depth));
		const models = found.filter((path) => depth(path) === highest);
		if (models.length > 1) throw new Refused((words) => words.severalModels(list(models, words.more)));
		if (models[0]) return models[0];
	}
	const baked = paths.some((path) => /^(bake\.json|plane\d\.png)$/.test(fileName(path)));
	throw new Refused((words) => (baked ? words.modelMissing : words.noModel(list(paths, words.more))));
}

function list(paths: string[], more: (count: number) => string): string {
	const shown = paths.length > 3 ? paths.slice(0, 2) : paths;
	return `${shown.join(', ')}${paths.length > shown.length ? ` ${more(paths.length - shown.length)}` : ''}`;
}

/** Where no server is, and the loader takes the rest of an address for a path. */
const SCHEME = 'own:/';

/**
 * The files as something that a loader loads from: each gets an address in memory when it is asked for, and what is not
 * among them is an error, never a request.
 *
 * @param path of the glTF file
 */
export function sourceOf(files: Files, path: string, container: Container): OwnSource {
	const made = new Map<Blob, string>();
	const manager = new LoadingManager().setURLModifier((url) => {
		// Pictures within the binary part of a .glb: the loader has made the address of such a one itself.
		if (/^(data|blob):/i.test(url)) return url;
		if (!url.startsWith(SCHEME)) throw new Refused((words) => words.elsewhere(url));
		const blob = fileAt(files, decode(url.slice(SCHEME.length)), container);
		const address = made.get(blob) ?? URL.createObjectURL(blob);
		made.set(blob, address);
		return address;
	});
	return {
		path,
		url: SCHEME + path.split('/').map(encodeURIComponent).join('/'),
		manager,
		release() {
			for (const address of made.values()) URL.revokeObjectURL(address);
			made.clear();
			files.clear();
		},
	};
}

/**
 * The file that a glTF file means.
 *
 * @param uri as it stands in the file
 * @param path of the glTF file
 * @throws Refused where there is none, or where it would have to be fetched
 */
export function fileOf(files: Files, uri: string, path: string, container: Container): Blob {
	if (/^([a-z][a-z0-9+.-]*:|\/)/i.test(uri)) throw new Refused((words) => words.elsewhere(uri));
	return fileAt(files, `${path.slice(0, path.lastIndexOf('/') + 1)}${decode(uri)}`, container);
}

function fileAt(files: Files, path: string, container: Container): Blob {
	const resolved = resolve(path.normalize('NFC'));
	// Made on a system that doesn't mind case, perhaps.
	const same = (other: string) => other.toLowerCase() === resolved?.toLowerCase();
	const found = files.get(resolved ?? '') ?? files.get([...files.keys()].find(same) ?? '');
	if (found) return found;
	const name = resolved ?? path;
	throw new Refused((words) =>
		({ zip: words.notInZip, folder: words.notInFolder, file: words.notBeside })[container](name),
	);
}

/** Without `.` and `..`; undefined where that leads out. */
function resolve(path: string): string | undefined {
	const names: string[] = [];
	for (const name of path.split('/')) {
		if (name === '..' && names.length === 0) return undefined;
		if (name === '..') names.pop();
		else if (name !== '.') names.push(name);
	}
	return names.join('/');
}

/** Names of an address as they are; one with a stray % is taken as it stands. */
function decode(path: string): string {
	return path
		.split('/')
		.map((name) => {
			try {
				return decodeURIComponent(name);
			} catch {
				return name;
			}
		})
		.join('/');
}
