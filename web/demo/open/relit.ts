/** Pictures of museums among dropped files: PTM, or a folder of relight. */

import { decode } from '../../rti/decode.ts';
import { parsePtm } from '../../rti/ptm.ts';
import { parseRelight } from '../../rti/relight.ts';
import { type Relit, RelitError } from '../../rti/relit.ts';
import { depth, type Files, list } from './files.ts';
import { Refused } from './refusal.ts';

const INFO = /(^|\/)info\.json$/i;
const PLANE = /(^|\/)plane_\d+\.(jpg|png)$/;

/**
 * Path of the one picture that is relit, on the highest level that has one; undefined where there is none, or a model beside it.
 *
 * @throws Refused where there are several
 */
export function findRelit(files: Files): string | undefined {
	const paths = [...files.keys()];
	if (paths.some((path) => /\.(gltf|glb)$/i.test(path))) return undefined;
	const found = paths.filter((path) => /\.ptm$/i.test(path) || (INFO.test(path) && planeBeside(files, path)));
	const highest = Math.min(...found.map(depth));
	const pictures = found.filter((path) => depth(path) === highest);
	if (pictures.length > 1) throw new Refused((words) => words.severalPictures(list(pictures, words.more)));
	return pictures[0];
}

const folderOf = (path: string) => path.slice(0, path.lastIndexOf('/') + 1);
/** Whether any of its planes is there, so that a missing one can be told. */
const planeBeside = (files: Files, path: string) =>
	[...files.keys()].some((other) => folderOf(other) === folderOf(path) && PLANE.test(other));

/** @throws Refused that says what is wrong with it */
export async function openRelit(files: Files, path: string): Promise<Relit> {
	const file = files.get(path) as Blob;
	try {
		return INFO.test(path)
			? await parseRelight(await file.text(), (name) => files.get(folderOf(path) + name), decode)
			: await parsePtm(new Uint8Array(await file.arrayBuffer()), decode);
	} catch (error) {
		if (!(error instanceof RelitError)) throw error;
		const { problem, detail } = error;
		throw new Refused((words) => words.relit[problem](detail));
	}
}
