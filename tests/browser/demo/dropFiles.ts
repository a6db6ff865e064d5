/** Files that are let go of above the picture. */

import type { Page } from '@playwright/test';

/** Bytes by name. */
export type Files = Record<string, Uint8Array>;

/** Drops files, without their folders, onto the picture. */
export async function dropFiles(page: Page, files: Files): Promise<void> {
	const parts = Object.entries(files).map(([name, bytes]) => [name, Buffer.from(bytes).toString('base64')] as const);
	await page.evaluate((parts) => {
		const transfer = new DataTransfer();
		for (const [name, base64] of parts)
			transfer.items.add(new File([Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0))], name));
		const event = new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer: transfer });
		document.getElementById('picture')?.dispatchEvent(event);
	}, parts);
}
