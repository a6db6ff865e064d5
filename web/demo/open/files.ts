/** Files without a server, and the model among them. Knows neither page nor zip. */

import { LoadingManager } from 'three';
import type { Source } from '../../scene/load.ts';
import { Refused } from './refusal.ts';

/** Files by path: `/` between folders, normal form C. */
export type Files = Map<string, Blob>;

/** Container that the files came in; errors name it. */
export type Container = 'zip' | 'folder' | 'file';

export interface Limits {
	/** Bytes of a zip; bytes of all files, unpacked. */
	zip: number;
	bytes: number;
	files: number;
}

/** Ten times the heaviest preset's bake, and within a phone's memory. */
export const LIMITS: Limits = { zip: 100e6, bytes: 300e6, files: 1000 };

/** Depth at which a model is still found: zips often wrap one or two folders. */
const MAX_DEPTH = 2;

/** Source whose files the page itself holds. */
export interface OwnSource extends Source {
	/** path of the glTF file */
	path: string;
	/** Revokes the addresses of its files; none can be loaded any more. */
	release(): void;
}

/** True for files that operating systems leave in folders. */
export function isIgnored(path: string): boolean {
	return path.split('/').some((name) => /^(\.|__MACOSX$|thumbs\.db$|desktop\.ini$)/i.test(name));
}

/** Folders above a file. */
export const depth = (path: string) => path.split('/').length - 1;
const fileName = (path: string) => path.split('/').at(-1) as string;

/**
 * Path of the one model: `model.gltf`, or else any glTF file, on the highest level that has one.
 *
 * @throws Refused for none, or several
 */
export function findModel(files: Files): string {
	const paths = [...files.keys()];
	for (const wanted of [/^model\.gltf$/i, /\.(gltf|glb)$/i]) {
		const found = paths.filter((path) => depth(path) <= MAX_DEPTH && wanted.test(fileName(path)));
		const highest = Math.min(...found.map(depth));
		const models = found.filter((path) => depth(path) === highest);
		if (models.length > 1) throw new Refused((words) => words.severalModels(list(models, words.more)));
		if (models[0]) return models[0];
	}
	const baked = paths.some((path) => /^(bake\.json|plane\d\.png)$/.test(fileName(path)));
	throw new Refused((words) => (baked ? words.modelMissing : words.noModel(list(paths, words.more))));
}

/** The first paths in words. */
export function list(paths: string[], more: (count: number) => string): string {
	const shown = paths.length > 3 ? paths.slice(0, 2) : paths;
	return `${shown.join(', ')}${paths.length > shown.length ? ` ${more(paths.length - shown.length)}` : ''}`;
}

/** Scheme of made-up addresses, whose rest the loader takes for a path. */
const SCHEME = 'own:/';

/**
 * A source that loads from the files: each gets a blob address on demand; a file that is missing is an error, never a
 * request.
 *
 * @param path of the glTF file
 */
export function sourceOf(files: Files, path: string, container: Container): OwnSource {
	const made = new Map<Blob, string>();
	const manager = new LoadingManager().setURLModifier((url) => {
		// Images in a .glb's binary chunk have an address that the loader has made.
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
 * File of a URI in a glTF file.
 *
 * @param uri as written in the file
 * @param path of the glTF file
 * @throws Refused for a missing file, or one that would have to be fetched
 */
export function fileOf(files: Files, uri: string, path: string, container: Container): Blob {
	if (/^([a-z][a-z0-9+.-]*:|\/)/i.test(uri)) throw new Refused((words) => words.elsewhere(uri));
	return fileAt(files, `${path.slice(0, path.lastIndexOf('/') + 1)}${decode(uri)}`, container);
}

function fileAt(files: Files, path: string, container: Container): Blob {
	const resolved = resolve(path.normalize('NFC'));
	// Some file systems ignore case.
	const same = (other: string) => other.toLowerCase() === resolved?.toLowerCase();
	const found = files.get(resolved ?? '') ?? files.get([...files.keys()].find(same) ?? '');
	if (found) return found;
	const name = resolved ?? path;
	throw new Refused((words) =>
		({ zip: words.notInZip, folder: words.notInFolder, file: words.notBeside })[container](name),
	);
}

/** Resolves `.` and `..`; undefined for a path that leads out. */
function resolve(path: string): string | undefined {
	const names: string[] = [];
	for (const name of path.split('/')) {
		if (name === '..' && names.length === 0) return undefined;
		if (name === '..') names.pop();
		else if (name !== '.') names.push(name);
	}
	return names.join('/');
}

/** Decodes the names of a URI; one with a stray % stays as written. */
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
