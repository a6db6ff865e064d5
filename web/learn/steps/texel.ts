/** One texel: what was measured under every lamp, its polynomial, its six numbers and their bytes. */

import { controlRow } from '../controls.ts';
import type { Mount } from '../lesson.ts';
import { Chosen } from '../measured/chosen.ts';
import { lightColour } from '../measured/colours.ts';
import { drawDisc } from '../measured/disc.ts';
import { angleBetween, nearest, toTile } from '../measured/lights.ts';
import { layerChoice, line, live, ramp } from '../measured/parts.ts';
import { decimal, draw, legend, Plot, scale } from '../measured/plot.ts';
import { drawSlice, lightFromAbove, panel, panels, texelByHand } from '../measured/slice.ts';
import { drawSurface } from '../measured/surface.ts';
import { NumberTable, Substituted, type Sums } from '../measured/table.ts';
import { TexelState } from '../measured/texel.ts';
import { wordsIn } from '../measured/words.ts';

/** The disc's radius, in halves of its canvas. */
const DISC = 0.92;

export const mount: Mount = async (place, lesson) => {
	const words = wordsIn(lesson.language);
	const chosen = await Chosen.of(lesson);
	const { lamps, record } = chosen;
	const { light } = lesson;
	const state = new TexelState(chosen);

	const row = panels(place, 2);
	const slice = panel(row, words.pickTexel);
	const disc = panel(row, words.disc);
	ramp(place, lesson, record.peak);
	layerChoice(controlRow(place), lesson, chosen);
	texelByHand(slice.canvas, chosen);
	lightFromAbove(disc.canvas, light, DISC);

	const sum = new Substituted(place, words);
	const beside = panels(place, 2);
	const surfaceBox = document.createElement('div');
	const tableBox = document.createElement('div');
	beside.append(surfaceBox, tableBox);
	const surface = new Plot(surfaceBox, words.surface, 340, (svg, width, height) =>
		drawSurface(svg, width, height, state, toTile(light.direction), chosen),
	);
	legend(surfaceBox, [
		['dot', 'truth', words.lampOfFit],
		['diamond', 'truth', words.lampHeldOut],
		['line', 'stick more', words.above],
		['line', 'stick less', words.below],
	]);
	const errorSays = line(surfaceBox);
	const table = new NumberTable(tableBox, words);
	const values = chosen.ptm.singularValues;
	new Plot(tableBox, words.singular, 170, (svg, width, height) => {
		const y = scale([0, values[0] ?? 1], [height - 24, 46]);
		const step = Math.min(width / values.length, 96);
		draw(svg, 'text', { class: 'name', x: 2, y: 13 }, words.singular);
		values.forEach((value, i) => {
			const x = step * (i + 0.5);
			const top = y(value);
			draw(svg, 'rect', { class: 'column', x: x - step * 0.28, y: top, width: step * 0.56, height: height - 24 - top });
			draw(svg, 'text', { class: 'value', x, y: top - 5, 'text-anchor': 'middle' }, decimal(value));
			draw(svg, 'text', { x, y: height - 8, 'text-anchor': 'middle' }, `σ${'₁₂₃₄₅₆'[i]}`);
		});
	});
	line(tableBox)(words.condition(decimal((values[0] ?? 1) / (values.at(-1) ?? 1), 1)));

	const nearestLamp = () => nearest(lamps, toTile(light.direction));
	live(lesson, chosen, [
		[
			slice.canvas,
			() => {
				const measured = chosen.measured(nearestLamp());
				const colour = (texel: number) => lightColour(measured[texel] ?? 0, record.peak);
				drawSlice(slice.canvas, chosen.layer, colour, chosen);
				slice.canvas.dataset.texel = `${chosen.column},${chosen.row}`;
				slice.say(words.texelAt(chosen.column, chosen.row));
			},
		],
		[
			disc.canvas,
			() => {
				const at = toTile(light.direction);
				const lamp = nearestLamp();
				const sums: Sums = {
					light: at,
					exact: state.relit(at),
					stored: state.relitStored(at),
					measured: state.measured[lamp] ?? 0,
					away: angleBetween(at, lamps[lamp] ?? at),
				};
				drawDisc(disc.canvas, state, at, chosen, DISC);
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
