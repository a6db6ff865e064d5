import { type CompressedArrayTexture, DataTexture, FloatType, RGBAFormat, type Texture } from 'three';
import { SlabMeans, type Slabs, standIns } from './trim.ts';

/** Lookup table for cut fur: change of the light moments per slab. */
export class TrimLight {
	/** Four texels a slab: see shaders/trimmed.glsl. */
	readonly texture: DataTexture;
	readonly #slabs: Slabs;
	#means: SlabMeans | undefined;

	/**
	 * @param planes of coefficients, whose first levels hold `layers` slabs one after the other; of several states only the
	 * first is read
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

	/** Places in whole fur with the light that the slabs of cut fur get; see `standIns`. */
	places(share: number): Float64Array {
		return standIns(this.#slabs, share);
	}

	/** Light slabs as at these places. */
	set(places: Float64Array): void {
		this.#means ??= new SlabMeans(this.#slabs);
		this.#means.fill(places, this.texture.image.data as Float32Array);
		this.texture.needsUpdate = true;
	}
}
