/** Export of a page's content as text or file. */

/** @returns whether the text is in the clipboard */
export async function copy(text: string): Promise<boolean> {
	try {
		// Missing on insecure pages, and the visitor may refuse.
		await navigator.clipboard.writeText(text);
		return true;
	} catch {
		return copyBySelection(text);
	}
}

/** Fallback without the clipboard API. */
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

/** Offers a file for download. */
export function download(file: Blob, name: string): void {
	const link = document.createElement('a');
	link.href = URL.createObjectURL(file);
	link.download = name;
	link.click();
	// After the browser has begun to read it.
	setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
