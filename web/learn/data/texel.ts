/** Numbers of one texel: fitted, stored, measured. */

import type { Direction } from '../../fur/reference.ts';
import { dequantise, polynomial, relitTexels } from './fit.ts';
import type { Selection } from './Selection.ts';

const eq2 = polynomial([0, 1, 2, 3, 4, 5]);

export class TexelState {
	constructor(private readonly selection: Selection) {}

	/** Six numbers by least squares. */
	get exact(): number[] {
		const { numbers, place } = this.selection;
		return Array.from(numbers.subarray(place * 6, place * 6 + 6));
	}

	/** Bytes in the asset. */
	get codes(): Uint8Array {
		const { layer, place } = this.selection;
		return layer.codes.subarray(place * 6, place * 6 + 6);
	}

	/** Six numbers decoded from the bytes. */
	get stored(): number[] {
		return Array.from(dequantise(this.codes, this.selection.record));
	}

	/** Measured L under every lamp, those of the fit first. */
	get measured(): number[] {
		return this.selection.lamps.map((_, lamp) => this.selection.measured(lamp)[this.selection.place] ?? 0);
	}

	relit(light: Direction): number {
		return relitTexels(Float64Array.from(this.exact), eq2(light))[0] ?? 0;
	}

	relitStored(light: Direction): number {
		return relitTexels(Float64Array.from(this.stored), eq2(light))[0] ?? 0;
	}

	/** Root mean squared errors over lamps of the fit and over held-out ones. */
	errors(): { fit: number; unseen: number } {
		const { lamps, record } = this.selection;
		const { exact, measured } = this;
		const square = lamps.map((light, i) => {
			const [relit = 0] = relitTexels(Float64Array.from(exact), eq2(light));
			return (relit - (measured[i] ?? 0)) ** 2;
		});
		const root = (part: number[]) => Math.sqrt(part.reduce((sum, value) => sum + value, 0) / part.length);
		return { fit: root(square.slice(0, record.fitted)), unseen: root(square.slice(record.fitted)) };
	}
}

/** L of a texel over the disc of lights, unclamped, so that its surface has no edge at 0. */
export const surfaceOf =
	(numbers: readonly number[]) =>
	(u: number, v: number): number =>
		eq2([u, v, 0]).reduce((sum, phi, i) => sum + phi * (numbers[i] ?? 0), 0);
