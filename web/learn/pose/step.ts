/** The light follows the pose: one vertex's frame and its six moments, before and after its joint turns under the lamp. */

import { listenToDrags } from '../../scene/drag.ts';
import { controlRow, figureCanvas, slider } from '../controls.ts';
import { seenFromAbove } from '../data/above.ts';
import { ARTICLE_FORM, loadFurry } from '../data/assets.ts';
import { takeKeys } from '../drag.ts';
import type { Mount } from '../lesson.ts';
import { line } from '../plot/parts.ts';
import { decimal, Plot } from '../plot/plot.ts';
import { panels } from '../plot/slice.ts';
import { drawBars } from './drawBars.ts';
import { drawLimb, Sheet } from './drawLimb.ts';
import { frameAt, lightOf, momentsIn, type Vector } from './frame.ts';
import { Hairs } from './hairs.ts';
import './style.css';

/** Turns of the joint: least, largest, first, and that of an arrow key; degrees. */
const [LEAST, MOST, FIRST, STEP] = [-70, 110, 55, 5];
const RADIANS = Math.PI / 180;

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.pose;
	const { fur } = await loadFurry(ARTICLE_FORM, lesson);
	const coefficients = seenFromAbove(fur);
	const brightest = lightOf(coefficients, [0, 0, 0, 0, 0, 1]);
	const row = panels(place, 2);
	row.classList.add('pose');
	const [left, right] = [document.createElement('div'), document.createElement('div')];
	row.append(left, right);
	const canvas = figureCanvas(left, words.picture, 1.06);
	canvas.classList.add('limb');

	let degrees = FIRST;
	const hairs = new Hairs();
	const light = (): Vector => {
		const { x, y, z } = lesson.light.direction;
		return [x, y, z];
	};
	const moments = (turn: number) => momentsIn(frameAt(turn * RADIANS), light());
	const picture = lesson.painter.picture(canvas, () =>
		drawLimb(canvas, hairs, degrees * RADIANS, light(), coefficients, brightest),
	);
	const bars = new Plot(right, words.bars, 232, (svg, width, height) =>
		drawBars(svg, width, height, moments(0), moments(degrees), words.columns),
	);
	const says = line(right);
	const show = () => {
		const [before, now] = [moments(0), moments(degrees)].map((m) => lightOf(coefficients, m)) as [number, number];
		canvas.dataset.moments = moments(degrees).join();
		says(words.says(decimal(before), decimal(now)));
		picture.redraw();
		bars.redraw();
	};
	const joint = slider(controlRow(place), {
		...{ label: words.joint, min: LEAST, max: MOST, step: 1, value: FIRST },
		text: (value) => words.degrees(decimal(value, 0)),
		input: (value) => {
			degrees = value;
			show();
		},
	});
	const turn = (to: number) => {
		joint.value = Math.round(Math.min(Math.max(to, LEAST), MOST));
	};
	listenToDrags(canvas, ({ x, y }) => {
		const sheet = new Sheet(canvas.width, canvas.height);
		turn(sheet.angleTo(((x + 1) / 2) * canvas.width, ((1 - y) / 2) * canvas.height) / RADIANS);
	});
	takeKeys(canvas, (across, up) => turn(degrees + STEP * (up || -across)));
	lesson.light.listen(show);
};
