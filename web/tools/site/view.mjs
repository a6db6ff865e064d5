/** `<fur-view>` as one file: its place on the site, and its decoder of compressed meshes, without WebAssembly. */
import { join } from 'node:path';
import { Failure, root } from '../process.mjs';

/** @import { Connect, Plugin, Rolldown } from 'vite' */

/** Decoder that meshoptimizer keeps as its reference: the same interface, in plain JavaScript. */
export const REFERENCE = join(root, 'node_modules', 'meshoptimizer', 'meshopt_decoder_reference.js');

/**
 * Makes the reference safe for data that ends too early: a number of several bytes ends with the data, too. As it stands it
 * reads on for ever.
 *
 * @param {string} source
 */
export function endingDecoder(source) {
	const [found, ended] = ['if (b < 0x80) return n;', 'if (!(b >= 0x80)) return n;'];
	if (source.split(found).length !== 3)
		throw new Failure(
			`${REFERENCE}: got another way to read numbers than this build knows, expected \`${found}\` twice`,
		);
	return source.replaceAll(found, ended);
}

/**
 * Takes the reference in place of three's decoder, which is WebAssembly: strict policies forbid that.
 *
 * @returns {Plugin}
 */
export function decoderPlugin() {
	return {
		name: 'furbake-decoder',
		enforce: 'pre',
		resolveId: (id) => (id === 'three/addons/libs/meshopt_decoder.module.js' ? REFERENCE : undefined),
		transform: (code, id) => (id === REFERENCE ? { code: endingDecoder(code), map: null } : undefined),
	};
}

const FILE = 'fur-view.js';
const CONFIG = join(root, 'web', 'vite.view.config.ts');

/** @returns {Promise<Map<string, string>>} the module and the licences in it, by their names */
async function buildView() {
	const { build } = await import('vite');
	const built = await build({ configFile: CONFIG, logLevel: 'error', build: { write: false } });
	const { output } = /** @type {Rolldown.RolldownOutput} */ (built);
	return new Map(output.map((file) => [file.fileName, file.type === 'chunk' ? file.code : `${file.source}`]));
}

/**
 * Puts the module on the site, where its page takes it from and visitors copy it; it is built on demand while one develops.
 *
 * @returns {Plugin}
 */
export function viewPlugin() {
	/** @type {ReturnType<typeof buildView> | undefined} */
	let files;
	return {
		name: 'furbake-view',
		configureServer({ middlewares, watcher }) {
			watcher.on('change', () => {
				files = undefined;
			});
			/** @type {Connect.NextHandleFunction} */
			const serve = async (request, response, next) => {
				const { pathname } = new URL(request.url ?? '/', 'http://localhost');
				if (pathname !== `/${FILE}`) return next();
				try {
					files ??= buildView();
					response.setHeader('Content-Type', 'text/javascript').end((await files).get(FILE));
				} catch (error) {
					files = undefined;
					next(error);
				}
			};
			middlewares.use(serve);
		},
		async generateBundle() {
			for (const [fileName, source] of await buildView()) this.emitFile({ type: 'asset', fileName, source });
		},
	};
}
