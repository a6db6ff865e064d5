/** Eq. (3): bits per number. The layer relit by rounded numbers, and the noise of rounding. */

import { controlRow, type Slider, slider } from '../controls.ts';
import { dequantise, polynomial, psnr, quantise, rangeOf, relitTexels } from '../data/fit.ts';
import { toTile } from '../data/lights.ts';
import type { Layer, LessonRecord } from '../data/measurements.ts';
import { Selection } from '../data/Selection.ts';
import { ask } from '../guide/ask.ts';
import type { Lesson, Mount } from '../lesson.ts';
import { drawBits } from '../plot/bits.ts';
import { differenceColour, lightColour } from '../plot/colours.ts';
import { layerChoice, line, live } from '../plot/parts.ts';
import { decimal, legend, Plot } from '../plot/plot.ts';
import { drawSlice, lightFromAbove, panel, panels } from '../plot/slice.ts';
import { RangeTable } from '../plot/table.ts';
import type { MeasuredWords } from '../words/index.ts';

const STORED = 8;
const AMPLIFIED = 8;
/** Decibels that count as a cost, and the bits offered as answers. */
const DEAR = 0.5;
const OFFERED = [7, 6, 4];
/** Coverage byte from which a texel's numbers are its own; emptier ones are blended with neighbours. */
const SOLID = 17;

const eq2 = polynomial([0, 1, 2, 3, 4, 5]);

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.measured;
	const selection = await Selection.of(lesson);
	const { record } = selection;
	let bits = STORED;

	const row = panels(place, 3);
	const exact = panel(row, words.unrounded);
	const rounded = panel(row, words.rounded(bits));
	const noise = panel(row, words.noise);
	for (const { canvas } of [exact, rounded, noise]) lightFromAbove(canvas, lesson);
	const controls = controlRow(place);
	const says = line(place);
	const beside = panels(place, 2);
	const curveBox = document.createElement('div');
	beside.append(curveBox);
	const table = new RangeTable(beside, words);
	const curve = new Plot(curveBox, words.noiseCurve, 220, (svg, width, height) =>
		drawBits(svg, width, height, record.bits, bits, words),
	);
	legend(curveBox, [
		['square', 'eigen', words.noiseLine],
		['dot', 'ptm', words.wholeLine],
	]);

	const rounding = new Rounding(selection);
	const both = () => {
		const moments = eq2(toTile(lesson.light.direction));
		return [relitTexels(selection.numbers, moments), relitTexels(rounding.numbers(bits), moments)] as const;
	};
	const colourOf = (light: Float32Array) => (texel: number) => lightColour(light[texel] ?? 0, record.peak);
	const redraw = live(lesson, selection, [
		[exact.canvas, () => drawSlice(exact.canvas, selection.layer, colourOf(both()[0]))],
		[rounded.canvas, () => drawSlice(rounded.canvas, selection.layer, colourOf(both()[1]))],
		[noise.canvas, () => drawNoise(noise, selection, words, ...both())],
	]);
	const chosen = slider(controls, {
		label: words.bits,
		min: 2,
		max: 10,
		step: 1,
		value: bits,
		text: String,
		input: (value) => {
			bits = value;
			rounded.say(words.rounded(bits));
			table.show(rangeOf(record, bits));
			const now = record.bits.find((entry) => entry.bits === bits);
			if (now) says(words.atBits(bits, String((6 * bits) / 8), decimal(now.psnr), decimal(now.noise)));
			curve.redraw();
			redraw();
		},
	});
	layerChoice(controls, lesson, selection);
	askForBits(place, lesson, record.bits, chosen);
};

/** Question on the bits that are needed; the answer takes the others away. */
function askForBits(place: HTMLElement, { words }: Lesson, entries: LessonRecord['bits'], chosen: Slider): void {
	const { bits: question } = words.ask;
	ask(place, question, () => {
		chosen.value = fewestBits(entries);
		const at = (bits: number) => decimal(entries.find((entry) => entry.bits === bits)?.psnr ?? 0);
		return {
			right: OFFERED.indexOf(chosen.value),
			because: question.because(chosen.value, at(chosen.value), at(STORED)),
		};
	});
}

/** Fewest of the bits whose rounding costs less than half a decibel. */
export function fewestBits(entries: LessonRecord['bits']): number {
	const all = entries.find(({ bits }) => bits === STORED)?.psnr ?? 0;
	return Math.min(...entries.filter(({ psnr: db }) => all - db < DEAR).map(({ bits }) => bits));
}

/** Rounded numbers of the selected layer, computed once per layer and number of bits. */
class Rounding {
	#made: { layer: Layer; bits: number; numbers: Float64Array } | undefined;

	constructor(readonly selection: Selection) {}

	numbers(bits: number): Float64Array {
		const { layer, numbers, ptm, record } = this.selection;
		if (this.#made?.layer !== layer || this.#made.bits !== bits) {
			const range = rangeOf(record, bits);
			this.#made = { layer, bits, numbers: dequantise(quantise(numbers, range, ptm.gram), range) };
		}
		return this.#made.numbers;
	}
}

/** Draws the difference of two relit layers, and writes its decibels. */
function drawNoise(
	{ canvas, say }: ReturnType<typeof panel>,
	{ layer, record }: Selection,
	words: MeasuredWords,
	exact: Float32Array,
	rounded: Float32Array,
): void {
	drawSlice(canvas, layer, (texel) =>
		differenceColour((AMPLIFIED * ((rounded[texel] ?? 0) - (exact[texel] ?? 0))) / record.peak),
	);
	const { alpha, texels } = layer;
	const weights = Array.from(texels, (texel) => ((alpha[texel] ?? 0) < SOLID ? 0 : (alpha[texel] ?? 0)));
	const now = psnr(rounded, exact, weights, record.peak);
	canvas.dataset.psnr = String(now);
	say(words.noiseNow(decimal(now, 1)));
}
