/** Errors of the selected layer over the held-out lamps, computed once per layer. */

import { RelitLayer } from '../data/relit.ts';
import type { Selection } from '../data/Selection.ts';
import { type BlockErrors, blockErrors, layerMean } from './blocks.ts';

/** Exponents of the squares' sides: 1 to 32 texels. */
export const LARGEST = 5;
/** Numbers per texel. */
const COUNT = 6;

interface Known {
	/** By the exponent of the squares' side. */
	errors: BlockErrors[];
	/** Mean light of the layer. */
	bright: number;
	/** Lamp under which the layer shares most of its error. */
	worst: number;
}

export class Errors {
	readonly #relit: RelitLayer;
	readonly #known = new Map<number, Known>();

	constructor(readonly selection: Selection) {
		this.#relit = new RelitLayer(selection, COUNT);
	}

	relit(lamp: number): Float32Array {
		return this.#relit.under('ptm', this.selection.lamps[lamp] ?? [0, 0, 1]);
	}

	/** Error that all texels of the layer have in common under a lamp. */
	shared(lamp: number): number {
		const { layer } = this.selection;
		return layerMean(layer, this.relit(lamp)) - layerMean(layer, this.selection.measured(lamp));
	}

	/** Under one lamp, in shares of the layer's mean light over all of them. @param side of the squares */
	under(lamp: number, side: number): BlockErrors {
		return blockErrors(this.selection.layer, [lamp], (each) => this.relit(each), side, this.known.bright);
	}

	get known(): Known {
		const { layer, record } = this.selection;
		let found = this.#known.get(layer.number);
		if (!found) {
			const lamps = Array.from({ length: record.held_out }, (_, i) => record.fitted + i);
			const light = new Map(lamps.map((lamp) => [lamp, this.relit(lamp)]));
			const errors = Array.from({ length: LARGEST + 1 }, (_, exponent) =>
				blockErrors(layer, lamps, (lamp) => light.get(lamp) ?? [], 2 ** exponent),
			);
			const sum = lamps.reduce((total, lamp) => total + layerMean(layer, this.selection.measured(lamp)), 0);
			const shared = lamps.map((lamp) => Math.abs(this.shared(lamp)));
			const worst = lamps[shared.indexOf(Math.max(...shared))] ?? record.fitted;
			found = { errors, bright: sum / lamps.length, worst };
			this.#known.set(layer.number, found);
		}
		return found;
	}
}
