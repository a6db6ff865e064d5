/** Eq. (3): how many bits a number needs. The layer relit by rounded numbers, and the noise of the rounding. */

import { controlRow, slider } from '../controls.ts';
import type { Mount } from '../lesson.ts';
import { Chosen } from '../measured/chosen.ts';
import { differenceColour, lightColour } from '../measured/colours.ts';
import { dequantise, polynomial, psnr, quantise, rangeOf, relitTexels } from '../measured/fit.ts';
import { toTile } from '../measured/lights.ts';
import type { Layer } from '../measured/measurements.ts';
import { layerChoice, line, live } from '../measured/parts.ts';
import { axes, decimal, draw, legend, mark, Plot, line as path } from '../measured/plot.ts';
import { drawSlice, lightFromAbove, panel, panels } from '../measured/slice.ts';
import { RangeTable } from '../measured/table.ts';
import { wordsIn } from '../measured/words.ts';

const STORED = 8;
const AMPLIFIED = 8;
/** Bytes of coverage from which a texel's numbers are its own: emptier ones take of their neighbours. */
const SOLID = 17;

const eq2 = polynomial([0, 1, 2, 3, 4, 5]);

export const mount: Mount = async (place, lesson) => {
	const words = wordsIn(lesson.language);
	const chosen = await Chosen.of(lesson);
	const { record } = chosen;
	let bits = STORED;

	const row = panels(place, 3);
	const exact = panel(row, words.unrounded);
	const rounded = panel(row, words.rounded(bits));
	const noise = panel(row, words.noise);
	for (const { canvas } of [exact, rounded, noise]) lightFromAbove(canvas, lesson.light);
	const controls = controlRow(place);
	const says = line(place);
	const beside = panels(place, 2);
	const curveBox = document.createElement('div');
	beside.append(curveBox);
	const table = new RangeTable(beside, words);
	const rows = record.bits.flatMap((entry) => [entry.psnr, entry.noise]);
	const [low, high] = [10 * Math.floor(Math.min(...rows) / 10), 10 * Math.ceil(Math.max(...rows) / 10)];
	const ticks = Array.from({ length: (high - low) / 10 + 1 }, (_, i) => low + 10 * i);
	const curve = new Plot(curveBox, words.noiseCurve, 220, (svg, width, height) => {
		const { x, y } = axes(
			svg,
			width,
			height,
			{ range: [2, 10], ticks: record.bits.map((entry) => entry.bits), label: words.bits },
			{ range: [low, high], ticks, label: words.decibels },
		);
		const now = record.bits.find((entry) => entry.bits === bits);
		draw(svg, 'line', { class: 'now', x1: x(bits), x2: x(bits), y1: y(low), y2: y(high) });
		for (const [key, kind, shape] of [
			['noise', 'eigen', 'square'],
			['psnr', 'ptm', 'dot'],
		] as const) {
			path(
				svg,
				record.bits.map((entry) => [x(entry.bits), y(entry[key])] as const),
				kind,
			);
			for (const entry of record.bits) mark(svg, shape, kind, x(entry.bits), y(entry[key]));
			if (!now) continue;
			const anchor = bits > 3 ? 'end' : 'start';
			const beside = x(bits) + (bits > 3 ? -8 : 8);
			draw(svg, 'text', { class: 'value', x: beside, y: y(now[key]) - 9, 'text-anchor': anchor }, decimal(now[key], 1));
		}
	});
	legend(curveBox, [
		['square', 'eigen', words.noiseLine],
		['dot', 'ptm', words.wholeLine],
	]);

	let made: { layer: Layer; bits: number; numbers: Float64Array } | undefined;
	/** The layer's numbers, rounded. */
	const numbers = () => {
		if (made?.layer !== chosen.layer || made.bits !== bits) {
			const range = rangeOf(record, bits);
			const codes = quantise(chosen.numbers, range, chosen.ptm.gram);
			made = { layer: chosen.layer, bits, numbers: dequantise(codes, range) };
		}
		return made.numbers;
	};
	const both = () => {
		const moments = eq2(toTile(lesson.light.direction));
		return [relitTexels(chosen.numbers, moments), relitTexels(numbers(), moments)] as const;
	};
	const colourOf = (light: Float32Array) => (texel: number) => lightColour(light[texel] ?? 0, record.peak);
	const redraw = live(lesson, chosen, [
		[exact.canvas, () => drawSlice(exact.canvas, chosen.layer, colourOf(both()[0]))],
		[rounded.canvas, () => drawSlice(rounded.canvas, chosen.layer, colourOf(both()[1]))],
		[
			noise.canvas,
			() => {
				const [a, b] = both();
				drawSlice(noise.canvas, chosen.layer, (texel) =>
					differenceColour((AMPLIFIED * ((b[texel] ?? 0) - (a[texel] ?? 0))) / record.peak),
				);
				const { alpha, texels } = chosen.layer;
				const weights = Array.from(texels, (texel) => ((alpha[texel] ?? 0) < SOLID ? 0 : (alpha[texel] ?? 0)));
				const now = psnr(b, a, weights, record.peak);
				noise.canvas.dataset.psnr = String(now);
				noise.say(words.noiseNow(decimal(now, 1)));
			},
		],
	]);
	slider(controls, {
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
	layerChoice(controls, lesson, chosen);
};
