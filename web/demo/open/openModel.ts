/** Dropped or chosen files → a model that can be loaded. This module is loaded with the first of them. */

import type { Language } from '../../page/language.ts';
import type { Relit } from '../../rti/relit.ts';
import { en as dropEn } from '../words/drop.en.ts';
import { zh as dropZh } from '../words/drop.zh.ts';
import { en } from '../words/refusals.en.ts';
import { zh } from '../words/refusals.zh.ts';
import { bakeCommand } from './command.ts';
import { type Handed, type Opened, open } from './entries.ts';
import { type Container, type Files, findModel, LIMITS, type Limits, type OwnSource, sourceOf } from './files.ts';
import { inspect } from './inspect.ts';
import { Refused } from './refusal.ts';
import { findRelit, openRelit } from './relit.ts';
import { unzip } from './zip.ts';

/** Model from the visitor's machine. */
export interface OwnModel {
	/** name of the folder, zip or file */
	name: string;
	source: OwnSource;
	/** Command that bakes it, for a model without fur. */
	command?: string;
	/** Picture of a museum that is relit, in place of a model. */
	relit?: Relit;
}

const KINDS: [kind: 'mesh' | 'picture' | 'text' | 'archive', extensions: RegExp][] = [
	// Formats that trimesh reads besides glTF.
	['mesh', /^(obj|ply|stl|off)$/],
	['picture', /^(png|jpe?g|webp|gif|avif|svg|bmp|tiff?|heic|exr|hdr)$/],
	['text', /^(txt|md|json|html?|css|js|ts|py|csv|pdf|docx?|rtf|toml)$/],
	['archive', /^(rar|7z|tar|gz|tgz|bz2|xz|zst)$/],
];

/** Localised reason for refusal. */
export interface Refusal {
	/** name of the folder, zip or file */
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
		return modelIn(name, files, container, limits);
	}
	const file = files.get(name) as Blob;
	if (file.size === 0) throw new Refused((words) => words.emptyFile);
	const extension = /\.([^.]*)$/.exec(name)?.[1]?.toLowerCase() ?? '';
	const bare = name.replace(/\.[^.]*$/, '');
	if (extension === 'zip' || (extension === '' && /zip/.test(file.type)))
		return modelIn(bare, await unzip(file, limits), 'zip', limits);
	if (extension === 'ptm') return { name: bare, ...(await relitIn(files, name)) };
	if (extension === 'glb' || extension === 'gltf') return modelIn(bare, files, container, limits);
	if (/^(plane\d|fin\d|colour|direction|fin-?colour)\.png$|^bake\.json$|^model\.bin$/.test(name))
		throw new Refused((words) => words.plane);
	const kind = KINDS.find(([, extensions]) => extensions.test(extension))?.[0];
	if (kind === 'mesh') throw new Refused((words) => words.mesh(extension, bakeCommand(name)));
	throw new Refused((words) => words[kind ?? 'unknown'](extension));
}

async function modelIn(name: string, files: Files, container: Container, limits: Limits): Promise<OwnModel> {
	const sum = [...files.values()].reduce((total, { size }) => total + size, 0);
	if (sum > limits.bytes) throw new Refused((words) => words.tooLarge(sum, limits.bytes));
	const picture = findRelit(files);
	if (picture) return { name, ...(await relitIn(files, picture)) };
	const path = findModel(files);
	const { furry } = await inspect(files, path, container);
	return { name, source: sourceOf(files, path, container), ...(furry ? {} : { command: bakeCommand(path) }) };
}

async function relitIn(files: Files, path: string): Promise<Pick<OwnModel, 'relit' | 'source'>> {
	const relit = await openRelit(files, path);
	files.clear();
	return { relit, source: { path, url: '', release() {} } };
}
