/** Models from the visitor's machine: dropped on the page or chosen in a dialog. Nothing is uploaded. */

import type { Language } from '../../page/language.ts';
import { fetchChecks } from '../../scene/load.ts';
import { en } from '../words/drop.en.ts';
import { zh } from '../words/drop.zh.ts';
import type { Handed } from './entries.ts';
import type { OwnModel } from './openModel.ts';

export type { OwnModel };

export interface DropHandlers {
	/** Called with a model that can be loaded; the receiver releases its source. */
	opened(model: OwnModel): Promise<void> | void;
	/** Called with the reason why it is none, in the page's language. */
	failed(name: string, reason: string): void;
	/** Called with the task from the drop until the model is on show or refused. */
	opening?(task: Promise<void>): void;
}

/** Dialogs of the system, for those without a mouse. */
export interface Opener {
	files(): void;
	/** undefined where the browser has no dialog for folders */
	folder: (() => void) | undefined;
}

/** Extensions and types: phones know few of the extensions. */
const ACCEPTED =
	'.zip,.glb,.gltf,.bin,.png,.jpg,.json,.ptm,application/zip,application/x-zip-compressed,model/gltf-binary,model/gltf+json,application/octet-stream';

/**
 * @param target receives the drops
 * @returns dialogs that open models without a drop
 */
export function listenToDrops(target: Window, language: Language, handlers: DropHandlers): Opener {
	const sign = dropSign({ en, zh }[language].drop);
	let latest = 0;
	async function take(handed: Handed): Promise<void> {
		const turn = ++latest;
		try {
			// Loaded on demand: most visits open nothing.
			const [{ openModel }] = await Promise.all([import('./openModel.ts'), fetchChecks()]);
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
		// Ignores moves between elements of the page.
		if (!event.relatedTarget) sign.hidden = true;
	});
	target.addEventListener('drop', (event) => {
		sign.hidden = true;
		if (!ofFiles(event) || !event.dataTransfer) return;
		event.preventDefault();
		start(handedOver(event.dataTransfer));
	});

	const chosen = (list: File[]) => start({ entries: [], files: list });
	const files = fileInput({ accept: ACCEPTED }, chosen);
	const folder = fileInput({ webkitdirectory: true }, chosen);
	return {
		files: () => files.click(),
		folder: 'webkitdirectory' in HTMLInputElement.prototype ? () => folder.click() : undefined,
	};
}

/** Sign over the page while files are dragged above it. */
function dropSign(text: string): HTMLElement {
	const sign = document.createElement('p');
	sign.id = 'drop';
	sign.hidden = true;
	sign.textContent = text;
	document.body.append(sign);
	return sign;
}

/** Hidden input that opens a dialog of the system. */
function fileInput(
	attributes: { accept?: string; webkitdirectory?: boolean },
	chosen: (files: File[]) => void,
): HTMLInputElement {
	const input = document.createElement('input');
	Object.assign<HTMLElement, object>(input, { type: 'file', multiple: true, hidden: true, ...attributes });
	input.addEventListener('change', () => {
		const files = [...(input.files ?? [])];
		// Lets the same file be chosen again.
		input.value = '';
		if (files.length) chosen(files);
	});
	document.body.append(input);
	return input;
}

/** Reads everything at once: after the event a DataTransfer is empty. */
function handedOver({ items, files }: DataTransfer): Handed {
	const entries = [...items].flatMap((item) => (item.kind === 'file' ? (item.webkitGetAsEntry?.() ?? []) : []));
	return entries.length ? { entries, files: [] } : { entries, files: [...files] };
}

function nameOf({ entries, files }: Handed): string {
	return entries[0]?.name ?? files[0]?.name ?? '';
}
