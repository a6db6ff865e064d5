/** Download of a file of an asset, with a second try where the first breaks off. */

import { Cache, FileLoader, type LoadingManager } from 'three';

/** File to download. */
export interface Download {
	url: string;
	requestHeader: Record<string, string>;
	withCredentials: boolean;
	/** False for a file that lost its end on the way. */
	isWhole: (bytes: ArrayBuffer) => boolean;
}

/**
 * Downloads a file. A connection that breaks off, an answer of 500 or more and a file that is not whole are tried once more;
 * the manager hears of one failure at most.
 *
 * @returns the file, whole or not
 * @throws TypeError for an address that is none
 * @throws Error of three's FileLoader
 */
export async function download(file: Download, manager: LoadingManager): Promise<ArrayBuffer> {
	const url = manager.resolveURL(file.url);
	// FileLoader would throw for a broken address, and wait without end at the second try.
	new Request(url);
	// The same manager, deaf to errors; with the same controller, which three's getter would make anew.
	const { abortController } = manager as LoadingManager & { abortController: AbortController };
	const quiet: LoadingManager = Object.create(manager, {
		abortController: { value: abortController },
		itemError: { value() {} },
	});
	try {
		const bytes = await load(file, quiet);
		if (file.isWhole(bytes)) return bytes;
	} catch (error) {
		if (isFinal(error)) {
			manager.itemError(url);
			throw error;
		}
	}
	Cache.remove(`file:${url}`);
	return load(file, manager, 'reload');
}

function load(file: Download, manager: LoadingManager, cache: 'default' | 'reload' = 'default'): Promise<ArrayBuffer> {
	const loader = new FileLoader(manager);
	loader.setResponseType('arraybuffer');
	loader.setRequestHeader(file.requestHeader);
	loader.setWithCredentials(file.withCredentials);
	loader.setCache(cache);
	return loader.loadAsync(file.url) as Promise<ArrayBuffer>;
}

/** True for errors that a second try would meet again: aborted by the app, or answered by the server. */
function isFinal(error: unknown): boolean {
	const { name, response } = error as Error & { response?: Response };
	return name === 'AbortError' || (response !== undefined && response.status < 500);
}
