import { type CompressedArrayTexture, DataTexture, FloatType, RGBAFormat, type Texture } from 'three';
import { hiddenShares, SlabMeans, type Slabs, standIns } from './trim.ts';

/** Lookup table for cut fur: change of the light moments per slab. */
export class TrimLight {
	/** Four texels a slab, fur after fur: see shaders/trimmed.glsl. */
	readonly texture: DataTexture;
	readonly #slabs: readonly Slabs[];
	#means: readonly SlabMeans[] | undefined;
	/** Result of `hidden` for a share. */
	#hidden: { share: number; heights: readonly number[] } = { share: 0, heights: [] };

	/**
	 * @param planes of coefficients, whose first levels hold `layers` slabs one after the other; of several states only the
	 * first is read
	 * @param codings of each fur
	 * @param depth layers of a fur's state in the texture
	 */
	constructor(
		planes: readonly Texture[],
		codings: readonly Pick<Slabs, 'scale' | 'bias'>[],
		layers: number,
		depth = layers,
	) {
		this.#slabs = codings.map(({ scale, bias }, fur) => {
			const bytes = planes.map((plane) => {
				const { image, mipmaps } = plane as CompressedArrayTexture;
				const data = mipmaps[0]?.data as Uint8Array;
				const size = (data.length * depth) / image.depth;
				return data.subarray(fur * size, (fur + 1) * size);
			});
			return { planes: bytes, scale, bias, layers };
		});
		const rows = layers * codings.length;
		this.texture = new DataTexture(new Float32Array(16 * rows), 4, rows, RGBAFormat, FloatType);
	}

	/** Places, of each fur, in whole fur with the light that the slabs of cut fur get; see `standIns`. */
	places(share: number): Float64Array[] {
		return this.#slabs.map((slabs) => standIns(slabs, share));
	}

	/** Shares of the height below which every fur is hardly seen, and faint; see `hiddenShares`. */
	hidden(share: number): readonly number[] {
		if (this.#hidden.share !== share) {
			const each = this.#slabs.map((slabs) => hiddenShares(slabs, share));
			this.#hidden = { share, heights: [0, 1].map((i) => Math.min(...each.map((heights) => heights[i] as number))) };
		}
		return this.#hidden.heights;
	}

	/** Light the slabs of each fur as at these places. */
	set(places: readonly Float64Array[]): void {
		this.#means ??= this.#slabs.map((slabs) => new SlabMeans(slabs));
		const table = this.texture.image.data as Float32Array;
		const each = table.length / this.#means.length;
		for (const [i, means] of this.#means.entries())
			means.fill(places[i] as Float64Array, table.subarray(i * each, (i + 1) * each));
		this.texture.needsUpdate = true;
	}
}
