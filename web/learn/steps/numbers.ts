/** Use of the numbers per texel: the polynomial, light curves found for this fur, and the optimum. */

import { choice, controlRow } from '../controls.ts';
import { psnr } from '../data/fit.ts';
import { nearest, toTile } from '../data/lights.ts';
import { type Kind, RelitLayer } from '../data/relit.ts';
import { Selection } from '../data/Selection.ts';
import type { Lesson, Mount } from '../lesson.ts';
import { differenceColour, lightColour } from '../plot/colours.ts';
import { drawArc, drawDecibels } from '../plot/numbers.ts';
import { layerChoice, line, live } from '../plot/parts.ts';
import { decimal, legend, Plot } from '../plot/plot.ts';
import { drawSlice, lightFromAbove, panel, panels, texelByHand } from '../plot/slice.ts';
import { TERMS } from '../plot/table.ts';

const MAX_NUMBERS = 6;
const AMPLIFIED = 2;

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.measured;
	const selection = await Selection.of(lesson);
	const { record } = selection;
	const relit = new RelitLayer(selection, MAX_NUMBERS);
	const { truth, shown } = slices(place, lesson, selection);
	const controls = controlRow(place);

	const arc = new Plot(place, words.arc, 220, (svg, width, height) =>
		drawArc(svg, width, height, { selection, relit, light: toTile(lesson.light.direction), words }),
	);
	legend(place, [
		['ring', 'truth', words.measuredMark],
		['line', 'ptm', words.ptm],
		['line', 'eigen', words.eigen],
	]);
	const figures = { ptm: record.ptm, eigen: record.eigen_figures, best: record.bound };
	const decibels = new Plot(place, words.byNumbers, 220, (svg, width, height) =>
		drawDecibels(svg, width, height, figures, relit.count, words),
	);
	legend(place, [
		['diamond', 'best', words.best],
		['square', 'eigen', words.eigen],
		['dot', 'ptm', words.ptm],
	]);
	const says = line(place);

	const redraw = liveSlices(lesson, relit, truth, shown, () => arc.redraw());
	const options = Object.fromEntries(record.ptm.map(({ numbers }) => [String(numbers), String(numbers)]));
	choice(controls, words.numbersOf, options, String(relit.count), (value) => {
		relit.count = Number(value);
		const { count } = relit;
		const at = (rows: typeof record.ptm) => decimal(rows.find(({ numbers }) => numbers === count)?.psnr ?? 0);
		const terms = record.terms.slice(0, count).map((term) => TERMS[term] ?? '');
		const [ptm, eigen, best] = [at(figures.ptm), at(figures.eigen), at(figures.best)];
		says(words.atNumbers({ count, terms, ptm, eigen, best }));
		arc.redraw();
		decibels.redraw();
		redraw();
	});
	layerChoice(controls, lesson, selection);
};

type Panel = ReturnType<typeof panel>;

/** Slice relit by one kind of numbers, and its difference from the measured one. */
interface Shown {
	kind: Kind;
	seen: Panel;
	off: Panel;
}

/** Rows of panels: the measured and both relit slices above, their differences below. */
function slices(place: HTMLElement, lesson: Lesson, selection: Selection): { truth: Panel; shown: Shown[] } {
	const words = lesson.words.measured;
	const row = panels(place, 3);
	const truth = panel(row, words.measured);
	texelByHand(truth.canvas, selection, words);
	const relit = (['ptm', 'eigen'] as const).map((kind) => ({ kind, seen: panel(row, words.relit(words[kind])) }));
	const below = panels(place, 3);
	line(below, 'note')(words.differs);
	const shown = relit.map(({ kind, seen }) => {
		const off = panel(below, kind === 'ptm' ? words.ptmOff : words.eigenOff);
		for (const { canvas } of [seen, off]) lightFromAbove(canvas, lesson);
		return { kind, seen, off };
	});
	truth.say(words.measured);
	return { truth, shown };
}

/**
 * Draws the slices under the held-out lamp nearest to the light, which no fit has seen.
 *
 * @param changed called with the measured slice
 * @returns function that redraws all of them
 */
function liveSlices(
	lesson: Lesson,
	relit: RelitLayer,
	truth: Panel,
	shown: readonly Shown[],
	changed: () => void,
): () => void {
	const { selection } = relit;
	const { record } = selection;
	const unseen = selection.lamps.slice(record.fitted);
	const lampNow = () => record.fitted + nearest(unseen, toTile(lesson.light.direction));
	const drawTruth = () => {
		const measured = selection.measured(lampNow());
		const colour = (texel: number) => lightColour(measured[texel] ?? 0, record.peak);
		drawSlice(truth.canvas, selection.layer, colour, selection);
		changed();
	};
	const now = (kind: Kind) => {
		const lamp = lampNow();
		return [selection.measured(lamp), relit.under(kind, selection.lamps[lamp] ?? [0, 0, 1])] as const;
	};
	const drawSeen = ({ kind, seen }: Shown) => {
		const [measured, made] = now(kind);
		drawSlice(seen.canvas, selection.layer, (texel) => lightColour(made[texel] ?? 0, record.peak));
		const { alpha, texels } = selection.layer;
		const weights = Array.from(texels, (texel) => alpha[texel] ?? 0);
		const db = psnr(made, measured, weights, record.peak);
		seen.canvas.dataset.psnr = String(db);
		const { ptmPanel, eigenPanel } = lesson.words.measured;
		seen.say((kind === 'ptm' ? ptmPanel : eigenPanel)(decimal(db, 1)));
	};
	const drawOff = ({ kind, off }: Shown) => {
		const [measured, made] = now(kind);
		drawSlice(off.canvas, selection.layer, (texel) =>
			differenceColour((AMPLIFIED * ((made[texel] ?? 0) - (measured[texel] ?? 0))) / record.peak),
		);
	};
	return live(lesson, selection, [
		[truth.canvas, drawTruth],
		...shown.flatMap((entry) => [
			[entry.seen.canvas, () => drawSeen(entry)] as const,
			[entry.off.canvas, () => drawOff(entry)] as const,
		]),
	]);
}
