/** Taking along what a page shows: as text, and as a file. */

/** @returns whether the text is in the clipboard */
export async function copy(text: string): Promise<boolean> {
	try {
		// Only pages that came over a safe connection have one, and the visitor may have said no.
		await navigator.clipboard.writeText(text);
		return true;
	} catch {
		return copyBySelection(text);
	}
}

/** As browsers did it before there was a clipboard for pages. */
function copyBySelection(text: string): boolean {
	const before = document.activeElement;
	const field = document.createElement('textarea');
	field.value = text;
	field.style.position = 'fixed';
	document.body.append(field);
	field.select();
	const copied = document.execCommand('copy');
	field.remove();
	if (before instanceof HTMLElement) before.focus();
	return copied;
}

/** Hands a file to the visitor. */
export function download(file: Blob, name: string): void {
	const link = document.createElement('a');
	link.href = URL.createObjectURL(file);
	link.download = name;
	link.click();
	// Not before the browser has begun to read it.
	setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
