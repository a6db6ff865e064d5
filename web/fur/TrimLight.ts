import { type CompressedArrayTexture, DataTexture, FloatType, RGBAFormat, type Texture } from 'three';
import { SlabMeans, type Slabs, standIns } from './trim.ts';

/** What the shaders look up of the light of fur that has been cut: for each slab how its light moments change. */
export class TrimLight {
	/** Four texels a slab: see shaders/trimmed.glsl. */
	readonly texture: DataTexture;
	readonly #slabs: Slabs;
	#means: SlabMeans | undefined;

	/**
	 * @param planes of coefficients, the first levels of which have `layers` slabs one after the other; of several states the
	 * first counts
	 * @param depth layers of a state's texture
	 */
	constructor(
		planes: readonly Texture[],
		{ scale, bias }: Pick<Slabs, 'scale' | 'bias'>,
		layers: number,
		depth = layers,
	) {
		const bytes = planes.map((plane) => {
			const { image, mipmaps } = plane as CompressedArrayTexture;
			const data = mipmaps[0]?.data as Uint8Array;
			return data.subarray(0, (data.length * depth) / image.depth);
		});
		this.#slabs = { planes: bytes, scale, bias, layers };
		this.texture = new DataTexture(new Float32Array(16 * layers), 4, layers, RGBAFormat, FloatType);
	}

	/** Where in whole fur slabs have the light that these have when a share is left of them: see `standIns`. */
	places(share: number): Float64Array {
		return standIns(this.#slabs, share);
	}

	/** Has slabs lit as at these places. */
	set(places: Float64Array): void {
		this.#means ??= new SlabMeans(this.#slabs);
		this.#means.fill(places, this.texture.image.data as Float32Array);
		this.texture.needsUpdate = true;
	}
}
