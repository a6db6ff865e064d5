/** Decoder of compressed meshes, fetched by the first file that has some. */

import { PACKED } from '../format.ts';

/** Methods that three's loader calls on `MeshoptDecoder`. */
export interface MeshDecoder {
	supported: boolean;
	decodeGltfBufferAsync(
		count: number,
		size: number,
		source: Uint8Array,
		mode: string,
		filter?: string,
	): Promise<Uint8Array>;
}

const fetchDecoder = async () =>
	(await import('three/addons/libs/meshopt_decoder.module.js')).MeshoptDecoder as MeshDecoder;

/** Whether a file's meshes are compressed. */
export function isPacked(json: { extensionsUsed?: string[] }): boolean {
	return json.extensionsUsed?.some((name) => PACKED.includes(name)) ?? false;
}

/**
 * Three's decoder in place of one that the app has set. It is on its way from now on, beside the meshes.
 *
 * Its promises reject with an Error that says what is wrong.
 */
export function meshDecoder(): MeshDecoder {
	const coming = fetchDecoder();
	coming.catch(() => {}); // reported where it is needed
	return {
		supported: true,
		async decodeGltfBufferAsync(...view) {
			try {
				const decoder = await coming;
				if (!decoder.supported) throw new Error('this browser has no WebAssembly');
				return await decoder.decodeGltfBufferAsync(...view);
			} catch (error) {
				throw new Error(`the meshes cannot be decoded (${(error as Error).message})`);
			}
		},
	};
}
