/** Decoder of compressed meshes for `<fur-view>`, without WebAssembly. */
import { join } from 'node:path';
import { Failure, root } from '../process.mjs';

/** @import { Plugin } from 'vite' */

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
