import { serve as serveSite } from '../../web/tools/vite.mjs';

/** Serves web/ for the tests. The address is handed to the workers in FURBAKE_URL; returns what ends it. */
export default async function serve(): Promise<() => Promise<void>> {
	const { url, close } = await serveSite();
	process.env.FURBAKE_URL = url;
	return close;
}
