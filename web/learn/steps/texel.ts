/** One texel: its measurements under every lamp, its polynomial, its six numbers and their bytes. */

import type { Direction } from '../../fur/reference.ts';
import { controlRow } from '../controls.ts';
import { angleBetween, nearest, toTile } from '../data/lights.ts';
import { Selection } from '../data/Selection.ts';
import { TexelState } from '../data/texel.ts';
import type { Mount } from '../lesson.ts';
import { lightColour } from '../plot/colours.ts';
import { drawDisc } from '../plot/disc.ts';
import { layerChoice, line, live, ramp } from '../plot/parts.ts';
import { decimal, draw, legend, Plot, scale } from '../plot/plot.ts';
import { drawSlice, lightFromAbove, panel, panels, texelByHand } from '../plot/slice.ts';
import { drawSurface } from '../plot/surface.ts';
import { NumberTable, Substituted, type Sums } from '../plot/table.ts';
import type { Words } from '../words/index.ts';

/** Radius of the disc, in halves of its canvas. */
const DISC = 0.92;

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.measured;
	const selection = await Selection.of(lesson);
	const { lamps, record } = selection;
	const { light } = lesson;
	const state = new TexelState(selection);

	const row = panels(place, 2);
	const slice = panel(row, words.pickTexel);
	const disc = panel(row, words.disc);
	ramp(place, lesson, record.peak);
	layerChoice(controlRow(place), lesson, selection);
	texelByHand(slice.canvas, selection, words);
	lightFromAbove(disc.canvas, lesson, DISC);

	const sum = new Substituted(place, words);
	const beside = panels(place, 2);
	const [surfaceBox, tableBox] = [document.createElement('div'), document.createElement('div')];
	beside.append(surfaceBox, tableBox);
	const surface = new Plot(surfaceBox, words.surface, 340, (svg, width, height) =>
		drawSurface(svg, width, height, state, toTile(light.direction), selection),
	);
	legend(surfaceBox, [
		['dot', 'truth', words.lampOfFit],
		['diamond', 'truth', words.lampHeldOut],
		['line', 'stick more', words.above],
		['line', 'stick less', words.below],
	]);
	const errorSays = line(surfaceBox);
	const table = new NumberTable(tableBox, words);
	plotSingularValues(tableBox, words, selection.ptm.singularValues);

	const nearestLamp = () => nearest(lamps, toTile(light.direction));
	live(lesson, selection, [
		[
			slice.canvas,
			() => {
				const measured = selection.measured(nearestLamp());
				const colour = (texel: number) => lightColour(measured[texel] ?? 0, record.peak);
				drawSlice(slice.canvas, selection.layer, colour, selection);
				slice.canvas.dataset.texel = `${selection.column},${selection.row}`;
				slice.say(words.texelAt(selection.column, selection.row));
			},
		],
		[
			disc.canvas,
			() => {
				const at = toTile(light.direction);
				const sums = sumsOf(state, at, nearestLamp(), lamps);
				drawDisc(disc.canvas, state, at, selection, DISC);
				disc.say(words.discSays(decimal(sums.exact)));
				sum.show(state, sums);
				table.show(state);
				surface.redraw();
				const { fit, unseen } = state.errors();
				errorSays(words.texelError(decimal(fit, 3), decimal(unseen, 3)));
			},
		],
	]);
};

/** Light of the texel, by the polynomial and as measured under the nearest lamp. */
function sumsOf(state: TexelState, light: Direction, lamp: number, lamps: readonly Direction[]): Sums {
	return {
		light,
		exact: state.relit(light),
		stored: state.relitStored(light),
		measured: state.measured[lamp] ?? 0,
		away: angleBetween(light, lamps[lamp] ?? light),
	};
}

/** Columns of the fit's singular values, and the condition of the fit. */
function plotSingularValues(place: HTMLElement, words: Words['measured'], values: ArrayLike<number>): void {
	const all = Array.from(values);
	const [first = 1, last = 1] = [all[0], all.at(-1)];
	new Plot(place, words.singular, 170, (svg, width, height) => {
		const y = scale([0, first], [height - 24, 46]);
		const step = Math.min(width / all.length, 96);
		draw(svg, 'text', { class: 'name', x: 2, y: 13 }, words.singular);
		all.forEach((value, i) => {
			const x = step * (i + 0.5);
			const top = y(value);
			draw(svg, 'rect', { class: 'column', x: x - step * 0.28, y: top, width: step * 0.56, height: height - 24 - top });
			draw(svg, 'text', { class: 'value', x, y: top - 5, 'text-anchor': 'middle' }, decimal(value));
			draw(svg, 'text', { x, y: height - 8, 'text-anchor': 'middle' }, String(i + 1));
		});
	});
	line(place)(words.condition(decimal(first / last, 1)));
}
