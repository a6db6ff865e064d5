/** Lamps under which every layer was sampled, and the layer as measured under the lit one. */

import { listenToDrags } from '../../scene/drag.ts';
import { controlRow, figureCanvas, spoken } from '../controls.ts';
import { elevationOf, nearest, neighbour, toTile, toWorld } from '../data/lights.ts';
import { Selection } from '../data/Selection.ts';
import { takeKeys } from '../drag.ts';
import { ask } from '../guide/ask.ts';
import { lostAtHorizon } from '../guide/sinking.ts';
import type { Lesson, Mount } from '../lesson.ts';
import { lightColour } from '../plot/colours.ts';
import { Dome } from '../plot/dome.ts';
import { layerChoice, line, live, ramp } from '../plot/parts.ts';
import { decimal, legend } from '../plot/plot.ts';
import { drawSlice, panel, panels } from '../plot/slice.ts';

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.measured;
	const selection = await Selection.of(lesson);
	const { lamps, record } = selection;

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
	layerChoice(controlRow(place), lesson, selection);
	askOfDepth(place, lesson, selection);

	const dome = new Dome(lamps, record.fitted);
	const nameOf = (lamp: number) => {
		const high = decimal(elevationOf(lamps[lamp] ?? [0, 0, 1]), 0);
		return lamp < record.fitted
			? words.lamp(lamp + 1, record.fitted, high)
			: words.heldOut(lamp - record.fitted + 1, record.held_out, high);
	};
	const say = spoken(box);
	const lit = lampByHand(canvas, dome, selection, lesson.light, (lamp) => say(nameOf(lamp)));
	const colourOf = (measured: Float32Array) => (texel: number) => lightColour(measured[texel] ?? 0, record.peak);
	live(lesson, selection, [
		[
			canvas,
			() => {
				const lamp = lit();
				dome.draw(canvas, lamp, selection.layer, colourOf(selection.measured(lamp)));
				canvas.dataset.lamp = String(lamp);
				lampSays(nameOf(lamp));
			},
		],
		[
			slice.canvas,
			() => {
				const lamp = lit();
				const measured = selection.measured(lamp);
				drawSlice(slice.canvas, selection.layer, colourOf(measured));
				const mean = measured.reduce((sum, value) => sum + value, 0) / measured.length;
				slice.canvas.dataset.mean = String(mean);
				slice.say(words.measuredUnder(decimal(elevationOf(lamps[lamp] ?? [0, 0, 1]), 0), decimal(mean)));
			},
		],
	]);
};

/** Question on deep layers and high ones; the answer lowers the lamp over the deepest. */
function askOfDepth(place: HTMLElement, { light, words }: Lesson, selection: Selection): void {
	const { dome } = words.ask;
	const [deepest, highest] = [0, selection.record.samples.length - 1];
	ask(place, dome, async () => {
		const layers = await Promise.all([deepest, highest].map((index) => selection.measurements.layer(index)));
		const [deep = 0, high = 0] = layers.map((layer) => lostAtHorizon(layer, selection.lamps));
		const low = selection.lamps.reduce((lowest, lamp) => (lamp[2] < lowest[2] ? lamp : lowest));
		light.set(...toWorld(low));
		await selection.show(deepest);
		const percent = (share: number) => decimal(100 * share, 0);
		return { right: deep > high ? 0 : 1, because: dome.because(percent(deep), percent(high)) };
	});
}

/**
 * Drags and arrow keys on the dome move the light from lamp to lamp.
 *
 * @param say tells the lamp that keys have asked for
 * @returns index of the lit one
 */
function lampByHand(
	canvas: HTMLCanvasElement,
	dome: Dome,
	{ lamps }: Selection,
	light: Lesson['light'],
	say: (lamp: number) => void,
): () => number {
	/** Target lamp of the moving light: the next key continues from there. */
	let asked: number | undefined;
	const lit = () => {
		const lamp = nearest(lamps, toTile(light.direction));
		if (lamp === asked) asked = undefined;
		return lamp;
	};
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
	takeKeys(canvas, (right, up) => {
		take(neighbour(lamps, asked ?? lit(), right, up));
		say(asked ?? lit());
	});
	return lit;
}
