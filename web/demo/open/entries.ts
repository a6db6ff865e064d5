/** Entries of a drop or a file dialog → files. */

import type { Container, Files } from './files.ts';
import { isIgnored, LIMITS, type Limits } from './files.ts';
import { Refused } from './refusal.ts';

/** Content of a drop, taken during the event: afterwards it is empty. */
export interface Handed {
	/** Entries, in browsers that know folders. */
	entries: FileSystemEntry[];
	/** Files, in others and from dialogs; those of a folder dialog have a path. */
	files: File[];
}

/** A file, which may be a zip, or all files of a folder. */
export interface Opened {
	name: string;
	container: Container;
	files: Files;
}

/** @param several names a number of files without a folder */
export async function open(
	{ entries, files }: Handed,
	several: (count: number) => string,
	limits: Limits = LIMITS,
): Promise<Opened> {
	const found: Files = new Map();
	const add = (path: string, file: Blob) => {
		if (isIgnored(path)) return;
		if (found.size >= limits.files) throw new Refused((words) => words.tooMany(limits.files));
		found.set(path.normalize('NFC'), file);
	};
	for (const file of files) add(pathOf(file), file);
	for (const entry of entries) await visit(entry, add);

	const [only] = found.keys();
	const folder = entries.some((entry) => entry.isDirectory) || files.some((file) => pathOf(file).includes('/'));
	if (found.size === 1 && only && !folder) return { name: only, container: 'file', files: found };
	const [top] = [...entries.map(({ name }) => name), ...files.map((file) => pathOf(file).split('/')[0])];
	const one = folder && entries.length < 2;
	return { name: (one && top) || several(found.size), container: 'folder', files: found };
}

/** Path of a file; those of a folder dialog have one. */
const pathOf = (file: File) => file.webkitRelativePath || file.name;

async function visit(entry: FileSystemEntry, add: (path: string, file: Blob) => void): Promise<void> {
	if (isIgnored(entry.name)) return;
	if (entry.isFile) {
		add(
			entry.fullPath.replace(/^\//, ''),
			await new Promise<File>((done, fail) => (entry as FileSystemFileEntry).file(done, fail)),
		);
	} else if (entry.isDirectory) {
		const reader = (entry as FileSystemDirectoryEntry).createReader();
		// Browsers give a hundred at a time, and an empty list at the end.
		for (;;) {
			const batch = await new Promise<FileSystemEntry[]>((done, fail) => reader.readEntries(done, fail));
			if (batch.length === 0) return;
			for (const child of batch) await visit(child, add);
		}
	}
}
