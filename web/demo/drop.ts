/** Models from the visitor's own machine: dropped on the page, or chosen in a dialog. Nothing is uploaded. */

import type { Language } from '../page/language.ts';
import type { Handed } from './entries.ts';
import type { OwnModel } from './opening.ts';
import { en } from './words/drop.en.ts';
import { zh } from './words/drop.zh.ts';

export type { OwnModel };

export interface DropHandlers {
	/** What was opened is a model that can be loaded; its source is the receiver's to release. */
	opened(model: OwnModel): Promise<void> | void;
	/** It is none; in the page's language. */
	failed(name: string, reason: string): void;
	/** Goes on from the drop until the model is on show, or refused. */
	opening?(task: Promise<void>): void;
}

/** The way in without a mouse: dialogs of the system. */
export interface Opener {
	files(): void;
	/** undefined where the browser has no dialog for folders */
	folder: (() => void) | undefined;
}

/** Types besides names: phones know few of the names. */
const ACCEPTED =
	'.zip,.glb,.gltf,.bin,.png,.json,application/zip,application/x-zip-compressed,model/gltf-binary,model/gltf+json,application/octet-stream';

/**
 * @param target what things are dropped on
 * @returns what opens them without being dropped
 */
export function listenToDrops(target: Window, language: Language, handlers: DropHandlers): Opener {
	const sign = document.createElement('p');
	sign.id = 'drop';
	sign.hidden = true;
	sign.textContent = { en, zh }[language].drop;
	document.body.append(sign);

	let latest = 0;
	async function take(handed: Handed): Promise<void> {
		const turn = ++latest;
		try {
			// Not with the page: most visits open nothing.
			const { openModel } = await import('./opening.ts');
			const model = await openModel(handed, language);
			const late = turn !== latest;
			if ('reason' in model) return late ? undefined : handlers.failed(model.name, model.reason);
			if (late) return model.source.release();
			await handlers.opened(model);
		} catch (error) {
			if (turn === latest) handlers.failed(nameOf(handed), (error as Error).message);
		}
	}
	function start(handed: Handed): void {
		const task = take(handed);
		handlers.opening?.(task);
	}

	const ofFiles = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
	for (const type of ['dragenter', 'dragover'] as const)
		target.addEventListener(type, (event) => {
			if (!ofFiles(event)) return;
			event.preventDefault();
			if (event.dataTransfer) event.dataTransfer.dropEffect = 'copy';
			sign.hidden = false;
		});
	target.addEventListener('dragleave', (event) => {
		// Not from one element of the page to another.
		if (!event.relatedTarget) sign.hidden = true;
	});
	target.addEventListener('drop', (event) => {
		sign.hidden = true;
		if (!ofFiles(event) || !event.dataTransfer) return;
		event.preventDefault();
		start(handedOver(event.dataTransfer));
	});

	const input = (attributes: { accept?: string; webkitdirectory?: boolean }) => {
		const made = document.createElement('input');
		Object.assign<HTMLElement, object>(made, { type: 'file', multiple: true, hidden: true, ...attributes });
		made.addEventListener('change', () => {
			const files = [...(made.files ?? [])];
			// So that the same one can be chosen again.
			made.value = '';
			if (files.length) start({ entries: [], files });
		});
		document.body.append(made);
		return made;
	};
	const [files, folder] = [input({ accept: ACCEPTED }), input({ webkitdirectory: true })];
	return {
		files: () => files.click(),
		folder: 'webkitdirectory' in HTMLInputElement.prototype ? () => folder.click() : undefined,
	};
}

/** Everything at once: after the event a DataTransfer is empty. */
function handedOver({ items, files }: DataTransfer): Handed {
	const entries = [...items].flatMap((item) => (item.kind === 'file' ? (item.webkitGetAsEntry?.() ?? []) : []));
	return entries.length ? { entries, files: [] } : { entries, files: [...files] };
}

function nameOf({ entries, files }: Handed): string {
	return entries[0]?.name ?? files[0]?.name ?? '';
}
