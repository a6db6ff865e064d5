/** From what was dropped or chosen to a model that can be loaded; fetched with the first of them. */

import type { Language } from '../page/language.ts';
import { bakeCommand } from './command.ts';
import { type Handed, type Opened, open } from './entries.ts';
import { type Container, type Files, findModel, LIMITS, type Limits, type OwnSource, sourceOf } from './files.ts';
import { inspect } from './gltf.ts';
import { Refused } from './refusal.ts';
import { en as dropEn } from './words/drop.en.ts';
import { zh as dropZh } from './words/drop.zh.ts';
import { en } from './words/refusals.en.ts';
import { zh } from './words/refusals.zh.ts';
import { unzip } from './zip.ts';

/** A model from the visitor's own machine. */
export interface OwnModel {
	/** of the folder, the zip or the file, as one would call it */
	name: string;
	source: OwnSource;
	/** For one without fur: how to bake it. */
	command?: string;
}

const kinds: [kind: 'mesh' | 'picture' | 'text' | 'archive', extensions: RegExp][] = [
	// What trimesh reads besides glTF.
	['mesh', /^(obj|ply|stl|off)$/],
	['picture', /^(png|jpe?g|webp|gif|avif|svg|bmp|tiff?|heic|exr|hdr)$/],
	['text', /^(txt|md|json|html?|css|js|ts|py|csv|pdf|docx?|rtf|toml)$/],
	['archive', /^(rar|7z|tar|gz|tgz|bz2|xz|zst)$/],
];

/** What is told instead, in the page's language. */
export interface Refusal {
	/** of what was opened */
	name: string;
	reason: string;
}

const sentences = { en: { ...dropEn, refusals: en }, zh: { ...dropZh, refusals: zh } };

export async function openModel(
	handed: Handed,
	language: Language,
	limits: Limits = LIMITS,
): Promise<OwnModel | Refusal> {
	const { files: several, refusals } = sentences[language];
	let opened: Opened | undefined;
	try {
		opened = await open(handed, several, limits);
		return await modelOf(opened, limits);
	} catch (error) {
		const name = opened?.name ?? handed.entries[0]?.name ?? handed.files[0]?.name ?? '';
		const reason = error instanceof Refused ? error.say(refusals) : refusals.unreadable((error as Error).message);
		return { name, reason };
	}
}

async function modelOf({ name, container, files }: Opened, limits: Limits): Promise<OwnModel> {
	if (container === 'folder') {
		if (files.size === 0) throw new Refused((words) => words.emptyFolder);
		return furnished(name, files, container, limits);
	}
	const file = files.get(name) as Blob;
	if (file.size === 0) throw new Refused((words) => words.emptyFile);
	const extension = /\.([^.]*)$/.exec(name)?.[1]?.toLowerCase() ?? '';
	const bare = name.replace(/\.[^.]*$/, '');
	if (extension === 'zip' || (extension === '' && /zip/.test(file.type)))
		return furnished(bare, await unzip(file, limits), 'zip', limits);
	if (extension === 'glb' || extension === 'gltf') return furnished(bare, files, container, limits);
	if (/^(plane\d|fin\d|colour|direction|fin-?colour)\.png$|^bake\.json$|^model\.bin$/.test(name))
		throw new Refused((words) => words.plane);
	const kind = kinds.find(([, extensions]) => extensions.test(extension))?.[0];
	if (kind === 'mesh') throw new Refused((words) => words.mesh(extension, bakeCommand(name)));
	throw new Refused((words) => words[kind ?? 'unknown'](extension));
}

async function furnished(name: string, files: Files, container: Container, limits: Limits): Promise<OwnModel> {
	const sum = [...files.values()].reduce((total, { size }) => total + size, 0);
	if (sum > limits.bytes) throw new Refused((words) => words.tooLarge(sum, limits.bytes));
	const path = findModel(files);
	const { furry } = await inspect(files, path, container);
	return { name, source: sourceOf(files, path, container), ...(furry ? {} : { command: bakeCommand(path) }) };
}
