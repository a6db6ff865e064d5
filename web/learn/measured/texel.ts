/** One texel's numbers: as fitted, as stored, as light. */

import type { Direction } from '../../fur/index.ts';
import type { Chosen } from './chosen.ts';
import { dequantise, polynomial, relitTexels } from './fit.ts';

const eq2 = polynomial([0, 1, 2, 3, 4, 5]);

export class TexelState {
	constructor(private readonly chosen: Chosen) {}

	/** The six numbers that least squares find. */
	get exact(): number[] {
		const { numbers, place } = this.chosen;
		return Array.from(numbers.subarray(place * 6, place * 6 + 6));
	}

	/** Their bytes in the asset. */
	get codes(): Uint8Array {
		const { layer, place } = this.chosen;
		return layer.codes.subarray(place * 6, place * 6 + 6);
	}

	/** What the bytes stand for. */
	get stored(): number[] {
		return Array.from(dequantise(this.codes, this.chosen.record));
	}

	/** L under every lamp, those of the fit first. */
	get measured(): number[] {
		return this.chosen.lamps.map((_, lamp) => this.chosen.measured(lamp)[this.chosen.place] ?? 0);
	}

	relit(light: Direction): number {
		return relitTexels(Float64Array.from(this.exact), eq2(light))[0] ?? 0;
	}

	relitStored(light: Direction): number {
		return relitTexels(Float64Array.from(this.stored), eq2(light))[0] ?? 0;
	}

	/** Root mean squared errors of the fit's lamps and of the others. */
	errors(): { fit: number; unseen: number } {
		const { lamps, record } = this.chosen;
		const { exact, measured } = this;
		const square = lamps.map((light, i) => {
			const [relit = 0] = relitTexels(Float64Array.from(exact), eq2(light));
			return (relit - (measured[i] ?? 0)) ** 2;
		});
		const root = (part: number[]) => Math.sqrt(part.reduce((sum, value) => sum + value, 0) / part.length);
		return { fit: root(square.slice(0, record.fitted)), unseen: root(square.slice(record.fitted)) };
	}
}

/** L of a texel over the lights of a disc, without the lower bound at 0, so that a surface has no edge there. */
export const surfaceOf =
	(numbers: readonly number[]) =>
	(u: number, v: number): number =>
		eq2([u, v, 0]).reduce((sum, phi, i) => sum + phi * (numbers[i] ?? 0), 0);
