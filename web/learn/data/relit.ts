/** Layer relit by some numbers per texel, in either basis. */

import type { Direction } from '../../fur/reference.ts';
import { type Curves, curvesFound, Fit, polynomial, relitTexels } from './fit.ts';
import type { Layer } from './measurements.ts';
import type { Selection } from './Selection.ts';

export type Kind = 'ptm' | 'eigen';

/** Layer relit by one kind of numbers. */
export interface Relit {
	curves: Curves;
	/** Numbers of every texel, texel after texel. */
	numbers: Float64Array;
}

/** Fits of the selected layer, each computed once. */
export class RelitLayer {
	readonly #known = new Map<string, Relit>();
	#layer: Layer | undefined;

	/** @param count numbers per texel */
	constructor(
		readonly selection: Selection,
		public count: number,
	) {}

	/** Numbers of the selected layer, and the functions that they multiply. */
	by(kind: Kind): Relit {
		const { layer, fitted, record } = this.selection;
		if (this.#layer !== layer) this.#known.clear();
		this.#layer = layer;
		const key = `${kind} ${this.count}`;
		let found = this.#known.get(key);
		if (!found) {
			const curves =
				kind === 'ptm' ? polynomial(record.terms.slice(0, this.count)) : curvesFound(record.eigen, this.count);
			found = { curves, numbers: new Fit(curves, fitted).texels(layer.light, layer.texels.length) };
			this.#known.set(key, found);
		}
		return found;
	}

	/** L of every texel with hair. */
	under(kind: Kind, direction: Direction): Float32Array {
		const { curves, numbers } = this.by(kind);
		return relitTexels(numbers, curves(direction));
	}
}
