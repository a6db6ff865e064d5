/** Layer and texel shown by the lesson's figures: a choice in one holds in all. */

import type { Direction } from '../../fur/reference.ts';
import type { Lesson } from '../lesson.ts';
import { Fit, polynomial } from './fit.ts';
import { type Layer, type LessonRecord, Measurements } from './measurements.ts';

/** First choice among the kept layers: halfway up, where hairs shade each other most. */
const FIRST_LAYER = 1;

const known = new WeakMap<Lesson, Promise<Selection>>();

export class Selection {
	/** Eq. (2) for the lights of the fit. */
	readonly ptm: Fit;
	#index = FIRST_LAYER;
	#place = 0;
	readonly #numbers = new WeakMap<Layer, Float64Array>();
	readonly #listeners = new Set<() => void>();

	private constructor(
		readonly measurements: Measurements,
		private shown: Layer,
	) {
		this.ptm = new Fit(polynomial([0, 1, 2, 3, 4, 5]), this.fitted);
		this.#near(shown.size / 2, shown.size / 2);
	}

	/** Choice of this lesson. @throws Error if the measurements cannot be loaded */
	static of(lesson: Lesson): Promise<Selection> {
		let selection = known.get(lesson);
		if (!selection) {
			selection = Measurements.open().then(async (all) => new Selection(all, await all.layer(FIRST_LAYER)));
			known.set(lesson, selection);
			selection.catch(() => known.delete(lesson));
		}
		return selection;
	}

	get record(): LessonRecord {
		return this.measurements.record;
	}

	get fitted(): Direction[] {
		return this.record.lights.slice(0, this.record.fitted);
	}

	/** Lamps of the fit, then those held out. */
	get lamps(): Direction[] {
		return this.record.lights.slice(0, this.record.fitted + this.record.held_out);
	}

	get layer(): Layer {
		return this.shown;
	}

	/** Index among the kept layers. */
	get index(): number {
		return this.#index;
	}

	/** Index of the texel among the layer's texels with hair. */
	get place(): number {
		return this.#place;
	}

	get row(): number {
		return Math.floor((this.shown.texels[this.#place] ?? 0) / this.shown.size);
	}

	get column(): number {
		return (this.shown.texels[this.#place] ?? 0) % this.shown.size;
	}

	/** Six unrounded numbers of every texel of the layer. */
	get numbers(): Float64Array {
		let found = this.#numbers.get(this.shown);
		if (!found) {
			found = this.ptm.texels(this.shown.light, this.shown.texels.length);
			this.#numbers.set(this.shown, found);
		}
		return found;
	}

	/** Measured L of every texel of the layer under one of `record.lights`. */
	measured(lamp: number): Float32Array {
		const { light, texels } = this.shown;
		return light.subarray(lamp * texels.length, (lamp + 1) * texels.length);
	}

	/** Shows another layer, at its texel nearest to the present one; stays if it cannot be loaded. */
	async show(index: number): Promise<void> {
		if (index === this.#index) return;
		this.#index = index;
		const [row, column] = [this.row, this.column];
		const layer = await this.measurements.layer(index).catch(() => undefined);
		// A later request may have replaced this one.
		if (index !== this.#index) return;
		if (layer) this.shown = layer;
		else this.#index = this.record.samples.findIndex(({ layer: number }) => number === this.shown.number);
		this.#near(row, column);
		this.#tell();
	}

	/** Chooses the texel with hair nearest to a place on the slice. */
	pick(row: number, column: number): void {
		this.#near(row, column);
		this.#tell();
	}

	/** Chooses the next texel with hair in a direction; wraps around as the tile does. */
	step(right: number, up: number): void {
		const { size, place } = this.shown;
		let [row, column] = [this.row, this.column];
		for (let i = 0; i < size; i++) {
			[row, column] = [(row + up + size) % size, (column + right + size) % size];
			const found = place[row * size + column] ?? -1;
			if (found < 0) continue;
			this.#place = found;
			this.#tell();
			return;
		}
	}

	/** Calls back on every change of layer or texel. */
	listen(listener: () => void): void {
		this.#listeners.add(listener);
	}

	#near(row: number, column: number): void {
		const { texels, size } = this.shown;
		let best = Number.POSITIVE_INFINITY;
		texels.forEach((texel, i) => {
			const away = (Math.floor(texel / size) - row) ** 2 + ((texel % size) - column) ** 2;
			if (away < best) [best, this.#place] = [away, i];
		});
	}

	#tell(): void {
		for (const listener of this.#listeners) listener();
	}
}
