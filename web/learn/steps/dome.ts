/** The lamps under which every layer was sampled, and the layer as measured under the one that is lit. */

import { controlRow, figureCanvas } from '../controls.ts';
import { arrows, listenToDrags } from '../drag.ts';
import type { Mount } from '../lesson.ts';
import { Chosen } from '../measured/chosen.ts';
import { lightColour } from '../measured/colours.ts';
import { Dome } from '../measured/dome.ts';
import { elevationOf, nearest, neighbour, toTile, toWorld } from '../measured/lights.ts';
import { layerChoice, line, live, ramp } from '../measured/parts.ts';
import { decimal, legend } from '../measured/plot.ts';
import { drawSlice, panel, panels } from '../measured/slice.ts';
import { wordsIn } from '../measured/words.ts';

export const mount: Mount = async (place, lesson) => {
	const words = wordsIn(lesson.language);
	const chosen = await Chosen.of(lesson);
	const { lamps, record } = chosen;
	const { light } = lesson;

	const row = panels(place, 2);
	const box = document.createElement('div');
	box.className = 'panel';
	row.append(box);
	const canvas = figureCanvas(box, words.dome, 1);
	canvas.classList.add('dome');
	const lampSays = line(box, 'lamp');
	const slice = panel(row, words.measuredSlice);
	legend(place, [
		['dot', 'lamp', words.lampOfFit],
		['diamond', 'lamp', words.lampHeldOut],
	]);
	ramp(place, lesson, record.peak);
	layerChoice(controlRow(place), lesson, chosen);

	const dome = new Dome(lamps, record.fitted);
	const lit = () => nearest(lamps, toTile(light.direction));
	/** The lamp that the light is on its way to: the next key goes on from there. */
	let asked: number | undefined;
	const take = (lamp: number | undefined) => {
		const direction = lamp === undefined ? undefined : lamps[lamp];
		if (!direction) return;
		asked = lamp;
		light.set(...toWorld(direction));
	};
	canvas.addEventListener('blur', () => {
		asked = undefined;
	});
	listenToDrags(canvas, ({ x, y }) => take(dome.lampAt(x, y)));
	arrows(canvas, (right, up) => take(neighbour(lamps, asked ?? lit(), right, up)));

	const colourOf = (measured: Float32Array) => (texel: number) => lightColour(measured[texel] ?? 0, record.peak);
	live(lesson, chosen, [
		[
			canvas,
			() => {
				const lamp = lit();
				if (lamp === asked) asked = undefined;
				dome.draw(canvas, lamp, chosen.layer, colourOf(chosen.measured(lamp)));
				const high = decimal(elevationOf(lamps[lamp] ?? [0, 0, 1]), 0);
				canvas.dataset.lamp = String(lamp);
				lampSays(
					lamp < record.fitted
						? words.lamp(lamp + 1, record.fitted, high)
						: words.heldOut(lamp - record.fitted + 1, record.held_out, high),
				);
			},
		],
		[
			slice.canvas,
			() => {
				const lamp = lit();
				const measured = chosen.measured(lamp);
				drawSlice(slice.canvas, chosen.layer, colourOf(measured));
				const mean = measured.reduce((sum, value) => sum + value, 0) / measured.length;
				slice.canvas.dataset.mean = String(mean);
				slice.say(words.measuredUnder(decimal(elevationOf(lamps[lamp] ?? [0, 0, 1]), 0), decimal(mean)));
			},
		],
	]);
};
