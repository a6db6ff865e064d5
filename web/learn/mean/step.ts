/** Texels err, means over neighbours hardly do. */

import { choice, controlRow, slider } from '../controls.ts';
import { nearest, toTile } from '../data/lights.ts';
import { RelitLayer } from '../data/relit.ts';
import { Selection } from '../data/Selection.ts';
import type { Lesson, Mount } from '../lesson.ts';
import { differenceColour, lightColour, type RGB } from '../plot/colours.ts';
import { layerChoice, line, live } from '../plot/parts.ts';
import { decimal, legend, Plot } from '../plot/plot.ts';
import { lightFromAbove, panel, panels } from '../plot/slice.ts';
import { type BlockErrors, blockErrors, blockMeans, layerMean } from './blocks.ts';
import { drawBlocks, drawErrors } from './draw.ts';

/** Exponents of the squares' sides: 1 to 32 texels. */
const LARGEST = 5;
/** Numbers per texel. */
const COUNT = 6;
const AMPLIFIED = 2;

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.mean;
	const selection = await Selection.of(lesson);
	const errors = new Errors(selection);
	let [exponent, without] = [0, false];

	const row = panels(place, 3);
	const names = [words.measured, words.relit, words.off(AMPLIFIED)];
	const [truth, relit, off] = names.map((name) => panel(row, name)) as [Panel, Panel, Panel];
	for (const { canvas } of [truth, relit, off]) lightFromAbove(canvas, lesson.light);
	const controls = controlRow(place);
	const says = line(place);
	const plot = new Plot(place, words.plot, 190, (svg, width, height) =>
		drawErrors(svg, width, height, errors.all(), exponent, words),
	);
	legend(place, [
		['dot', 'ptm', words.all],
		['square', 'eigen', words.own],
	]);

	const redraw = liveBlocks(lesson, errors, [truth, relit, off], () => ({ side: 2 ** exponent, without }));
	const changed = () => {
		const { all, own } = errors.all()[exponent] as BlockErrors;
		const percent = (share: number) => decimal(100 * share, 0);
		says(words.says(2 ** exponent, percent(all), percent(own)));
		place.dataset.wrong = String(without ? own : all);
		plot.redraw();
		redraw();
	};
	slider(controls, {
		label: words.side,
		min: 0,
		max: LARGEST,
		step: 1,
		value: 0,
		text: (value) => words.square(2 ** value),
		input: (value) => {
			exponent = value;
			changed();
		},
	});
	choice<'kept' | 'taken'>(controls, words.shared, words.sharing, 'kept', (way) => {
		without = way === 'taken';
		changed();
	});
	layerChoice(controls, lesson, selection);
	selection.listen(changed);
};

type Panel = ReturnType<typeof panel>;

/**
 * Draws measured and relit light and their difference, averaged, under the held-out lamp nearest to the light.
 *
 * @param chosen side of the squares, and whether the error that the layer shares is taken out
 * @returns function that redraws all of them
 */
function liveBlocks(
	lesson: Lesson,
	errors: Errors,
	[truth, relit, off]: readonly [Panel, Panel, Panel],
	chosen: () => { side: number; without: boolean },
): () => void {
	const { selection } = errors;
	const { record } = selection;
	const { peak } = record;
	const now = () => {
		const unseen = selection.lamps.slice(record.fitted);
		const lamp = record.fitted + nearest(unseen, toTile(lesson.light.direction));
		const measured = selection.measured(lamp);
		const made = errors.relit(lamp);
		const shared = layerMean(selection.layer, made) - layerMean(selection.layer, measured);
		return { measured, made: chosen().without ? made.map((value) => value - shared) : made };
	};
	const show = ({ canvas }: Panel, values: ArrayLike<number>, colour: (value: number) => RGB) => {
		const { side } = chosen();
		drawBlocks(canvas, blockMeans(selection.layer, values, side), side, colour);
	};
	const light = (value: number) => lightColour(value, peak);
	const difference = (value: number) => differenceColour((AMPLIFIED * value) / peak);
	return live(lesson, selection, [
		[truth.canvas, () => show(truth, now().measured, light)],
		[relit.canvas, () => show(relit, now().made, light)],
		[
			off.canvas,
			() => {
				const { measured, made } = now();
				const wrong = made.map((value, i) => value - (measured[i] ?? 0));
				show(off, wrong, difference);
			},
		],
	]);
}

/** Errors of the selected layer over the held-out lamps, computed once per layer. */
class Errors {
	readonly #relit: RelitLayer;
	readonly #known = new Map<number, BlockErrors[]>();

	constructor(readonly selection: Selection) {
		this.#relit = new RelitLayer(selection, COUNT);
	}

	relit(lamp: number): Float32Array {
		return this.#relit.under('ptm', this.selection.lamps[lamp] ?? [0, 0, 1]);
	}

	/** By the exponent of the squares' side. */
	all(): BlockErrors[] {
		const { layer, record } = this.selection;
		let found = this.#known.get(layer.number);
		if (!found) {
			const lamps = Array.from({ length: record.held_out }, (_, i) => record.fitted + i);
			const light = new Map(lamps.map((lamp) => [lamp, this.relit(lamp)]));
			found = Array.from({ length: LARGEST + 1 }, (_, exponent) =>
				blockErrors(layer, lamps, (lamp) => light.get(lamp) ?? [], 2 ** exponent),
			);
			this.#known.set(layer.number, found);
		}
		return found;
	}
}
