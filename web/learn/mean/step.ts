/** Texels err, means over neighbours hardly do. */

import { action, choice, controlRow, slider } from '../controls.ts';
import { elevationOf, nearest, toTile, toWorld } from '../data/lights.ts';
import { Selection } from '../data/Selection.ts';
import type { Lesson, Mount } from '../lesson.ts';
import { differenceColour, lightColour, type RGB } from '../plot/colours.ts';
import { layerChoice, line, live } from '../plot/parts.ts';
import { decimal, legend, Plot } from '../plot/plot.ts';
import { lightFromAbove, panel, panels } from '../plot/slice.ts';
import { type BlockErrors, blockMeans } from './blocks.ts';
import { drawBlocks, drawErrors } from './draw.ts';
import { Errors, LARGEST } from './Errors.ts';

const AMPLIFIED = 2;

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.mean;
	const selection = await Selection.of(lesson);
	const errors = new Errors(selection);
	let [exponent, without] = [0, false];

	const row = panels(place, 3);
	const names = [lesson.words.measured.measured, words.relit, words.off(AMPLIFIED)];
	const [truth, relit, off] = names.map((name) => panel(row, name)) as [Panel, Panel, Panel];
	for (const { canvas } of [truth, relit, off]) lightFromAbove(canvas, lesson);
	line(place)(lesson.words.measured.differs);
	const controls = controlRow(place);
	const says = line(place);
	const plot = new Plot(place, words.plot, 190, (svg, width, height) =>
		drawErrors(svg, width, height, errors.known.errors, exponent, words),
	);
	legend(place, [
		['dot', 'ptm', words.all],
		['square', 'eigen', words.own],
	]);

	const redraw = liveBlocks(lesson, errors, [truth, relit, off], () => ({ side: 2 ** exponent, without }));
	const changed = () => {
		const { all, own } = errors.known.errors[exponent] as BlockErrors;
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
	action(controls, words.worst, () => lesson.light.set(...toWorld(selection.lamps[errors.known.worst] ?? [0, 0, 1])));
	selection.listen(changed);
};

const percent = (share: number): string => decimal(100 * share, 0);

type Panel = ReturnType<typeof panel>;

/**
 * Draws measured and relit light and their difference, averaged, under the held-out lamp nearest to the light; until
 * somebody has moved the light, under the lamp whose shared error is largest.
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
	const words = lesson.words.mean;
	const unseen = selection.lamps.slice(record.fitted);
	const lampNow = () => {
		const { moved, direction } = lesson.light;
		return moved ? record.fitted + nearest(unseen, toTile(direction)) : errors.known.worst;
	};
	const now = () => {
		const lit = lampNow();
		const measured = selection.measured(lit);
		const made = errors.relit(lit);
		const shared = errors.shared(lit);
		return { measured, made: chosen().without ? made.map((value) => value - shared) : made };
	};
	const show = ({ canvas }: Panel, values: ArrayLike<number>, colour: (value: number) => RGB) => {
		const { side } = chosen();
		drawBlocks(canvas, blockMeans(selection.layer, values, side), side, colour);
	};
	const light = (value: number) => lightColour(value, peak);
	const difference = (value: number) => differenceColour((AMPLIFIED * value) / peak);
	return live(lesson, selection, [
		[
			truth.canvas,
			() => {
				show(truth, now().measured, light);
				const high = elevationOf(selection.lamps[lampNow()] ?? [0, 0, 1]);
				truth.say(words.measured(decimal(high, 0)));
			},
		],
		[relit.canvas, () => show(relit, now().made, light)],
		[
			off.canvas,
			() => {
				const { measured, made } = now();
				const wrong = made.map((value, i) => value - (measured[i] ?? 0));
				show(off, wrong, difference);
				const { all, own } = errors.under(lampNow(), chosen().side);
				off.say(words.offNow(AMPLIFIED, percent(all), percent(own)));
			},
		],
	]);
}
