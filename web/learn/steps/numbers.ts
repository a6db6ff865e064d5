/** Six numbers well used: the polynomial beside light curves found for this fur, and beside the best that can be. */

import type { Direction } from '../../fur/index.ts';
import { choice, controlRow } from '../controls.ts';
import type { Mount } from '../lesson.ts';
import { Chosen } from '../measured/chosen.ts';
import { differenceColour, lightColour } from '../measured/colours.ts';
import { type Curves, curvesFound, Fit, polynomial, psnr, relitTexels } from '../measured/fit.ts';
import { nearest, toTile } from '../measured/lights.ts';
import type { Layer } from '../measured/measurements.ts';
import { layerChoice, line, live } from '../measured/parts.ts';
import { axes, decimal, draw, legend, mark, Plot, line as path } from '../measured/plot.ts';
import { drawSlice, lightFromAbove, panel, panels, texelByHand } from '../measured/slice.ts';
import { wordsIn } from '../measured/words.ts';

const MOST = 6;
const AMPLIFIED = 2;
const ARC_STEPS = 80;

/** One way to spend numbers on a layer. */
interface Relit {
	curves: Curves;
	numbers: Float64Array;
}

export const mount: Mount = async (place, lesson) => {
	const words = wordsIn(lesson.language);
	const chosen = await Chosen.of(lesson);
	const { record } = chosen;
	const { light } = lesson;
	let count = MOST;

	const known = new Map<string, Relit>();
	let knownOf: Layer | undefined;
	const relit = (kind: 'ptm' | 'eigen'): Relit => {
		if (knownOf !== chosen.layer) known.clear();
		knownOf = chosen.layer;
		const key = `${kind} ${count}`;
		let found = known.get(key);
		if (!found) {
			const curves = kind === 'ptm' ? polynomial(record.terms.slice(0, count)) : curvesFound(record.eigen, count);
			const numbers = new Fit(curves, chosen.fitted).texels(chosen.layer.light, chosen.layer.texels.length);
			found = { curves, numbers };
			known.set(key, found);
		}
		return found;
	};
	const under = ({ curves, numbers }: Relit, direction: Direction) => relitTexels(numbers, curves(direction));

	const unseen = chosen.lamps.slice(record.fitted);
	/** The lamp nearest to the light among those that no fit saw. */
	const judge = () => record.fitted + nearest(unseen, toTile(light.direction));

	const row = panels(place, 3);
	const truth = panel(row, words.measured);
	texelByHand(truth.canvas, chosen);
	const shown = (['ptm', 'eigen'] as const).map((kind) => ({
		kind,
		seen: panel(row, words.relit(words[kind])),
		off: undefined as unknown as ReturnType<typeof panel>,
	}));
	const below = panels(place, 3);
	line(below, 'note')(words.differs);
	for (const entry of shown) {
		entry.off = panel(below, entry.kind === 'ptm' ? words.ptmOff : words.eigenOff);
		for (const { canvas } of [entry.seen, entry.off]) lightFromAbove(canvas, light);
	}
	truth.say(words.measured);
	const controls = controlRow(place);

	const arc = record.lights.slice(-record.angles.length);
	const curves = new Plot(place, words.arc, 230, (svg, width, height) => {
		const first = record.lights.length - arc.length;
		const measured = record.angles.map((angle, i) => [angle, chosen.measured(first + i)[chosen.place] ?? 0] as const);
		const top = Math.max(1, Math.ceil(Math.max(...measured.map(([, value]) => value)) + 0.2));
		const ticks = Array.from({ length: top + 1 }, (_, i) => i);
		const { x, y } = axes(
			svg,
			width,
			height,
			{ range: [-90, 90], ticks: [-80, -40, 0, 40, 80], label: words.arcAxis, text: (value) => decimal(value, 0) },
			{ range: [0, top], ticks, label: words.light },
		);
		const [, lv, lz] = toTile(light.direction);
		const now = (Math.atan2(lv, lz) * 180) / Math.PI;
		draw(svg, 'line', { class: 'now', x1: x(now), x2: x(now), y1: y(0), y2: y(top) });
		for (const { kind } of shown) {
			const { curves: functions, numbers } = relit(kind);
			const own = numbers.subarray(chosen.place * count, (chosen.place + 1) * count);
			const points = Array.from({ length: ARC_STEPS + 1 }, (_, i) => {
				const angle = ((2 * i) / ARC_STEPS - 1) * 84;
				const [s, c] = [Math.sin((angle * Math.PI) / 180), Math.cos((angle * Math.PI) / 180)];
				const [value = 0] = relitTexels(own, functions([0, s, c]));
				return [x(angle), y(Math.min(value, top))] as const;
			});
			path(svg, points, kind);
		}
		for (const [angle, value] of measured) mark(svg, 'ring', 'truth', x(angle), y(value));
	});
	legend(place, [
		['ring', 'truth', words.measuredMark],
		['line', 'ptm', words.ptm],
		['line', 'eigen', words.eigen],
	]);

	const figures = { ptm: record.ptm, eigen: record.eigen_figures, best: record.bound };
	const all = Object.values(figures).flatMap((rows) => rows.map(({ psnr: db }) => db));
	const [low, high] = [2 * Math.floor(Math.min(...all) / 2), 2 * Math.ceil(Math.max(...all) / 2)];
	const ticks = Array.from({ length: (high - low) / 2 + 1 }, (_, i) => low + 2 * i);
	const bars = new Plot(place, words.byNumbers, 230, (svg, width, height) => {
		const { x, y } = axes(
			svg,
			width,
			height,
			{ range: [0.6, 8.4], ticks: record.bound.map(({ numbers }) => numbers), label: words.numbersAxis },
			{ range: [low, high], ticks, label: words.decibels },
		);
		draw(svg, 'line', { class: 'now', x1: x(count), x2: x(count), y1: y(low), y2: y(high) });
		for (const [kind, shape] of [
			['best', 'diamond'],
			['eigen', 'square'],
			['ptm', 'dot'],
		] as const) {
			const points = figures[kind].map(({ numbers, psnr: db }) => [x(numbers), y(db)] as const);
			path(svg, points, kind);
			for (const [px, py] of points) mark(svg, shape, kind, px, py);
		}
	});
	legend(place, [
		['diamond', 'best', words.best],
		['square', 'eigen', words.eigen],
		['dot', 'ptm', words.ptm],
	]);
	const says = line(place);

	const redraw = live(lesson, chosen, [
		[
			truth.canvas,
			() => {
				const measured = chosen.measured(judge());
				const colour = (texel: number) => lightColour(measured[texel] ?? 0, record.peak);
				drawSlice(truth.canvas, chosen.layer, colour, chosen);
				curves.redraw();
			},
		],
		...shown.flatMap(({ kind, seen, off }) => {
			const now = () => {
				const lamp = judge();
				return [chosen.measured(lamp), under(relit(kind), chosen.lamps[lamp] ?? [0, 0, 1])] as const;
			};
			return [
				[
					seen.canvas,
					() => {
						const [measured, made] = now();
						drawSlice(seen.canvas, chosen.layer, (texel) => lightColour(made[texel] ?? 0, record.peak));
						const { alpha, texels } = chosen.layer;
						const weights = Array.from(texels, (texel) => alpha[texel] ?? 0);
						const db = psnr(made, measured, weights, record.peak);
						seen.canvas.dataset.psnr = String(db);
						seen.say((kind === 'ptm' ? words.ptmPanel : words.eigenPanel)(decimal(db, 1)));
					},
				],
				[
					off.canvas,
					() => {
						const [measured, made] = now();
						drawSlice(off.canvas, chosen.layer, (texel) =>
							differenceColour((AMPLIFIED * ((made[texel] ?? 0) - (measured[texel] ?? 0))) / record.peak),
						);
					},
				],
			] as const;
		}),
	]);
	const options = Object.fromEntries(record.ptm.map(({ numbers }) => [String(numbers), String(numbers)]));
	choice(controls, words.numbersOf, options, String(count), (value) => {
		count = Number(value);
		const at = (rows: typeof record.ptm) => decimal(rows.find(({ numbers }) => numbers === count)?.psnr ?? 0);
		says(words.atNumbers(count, at(figures.ptm), at(figures.eigen), at(figures.best)));
		curves.redraw();
		bars.redraw();
		redraw();
	});
	layerChoice(controls, lesson, chosen);
};
