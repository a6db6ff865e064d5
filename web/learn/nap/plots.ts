/** Plots of the factor of light and eye beside the pictures: around the fur, and over it. */

import { MathUtils, type Vector3 } from 'three';
import type { FurAsset } from '../../fur/index.ts';
import { legend, Plot } from '../plot/plot.ts';
import { panels } from '../plot/slice.ts';
import type { Words } from '../words/index.ts';
import { factorSeen, type Way } from './law.ts';
import { drawAround, drawOver } from './polar.ts';

/** Fur on show, with present light and eye. Angles are degrees. */
export interface NapState {
	asset: FurAsset;
	/** Mean coverage of each slab, by `coverages`. */
	covers: readonly number[];
	/** Direction of the hairs' tips, from the front to the right. */
	leaning: number;
	/** Unit vector to the lamp, world axes. */
	direction: Readonly<Vector3>;
	eye: Readonly<{ azimuth: number; elevation: number }>;
}

/** Degrees from the front to the right. */
export const azimuthOf = ({ x, z }: Readonly<Vector3>): number => MathUtils.radToDeg(Math.atan2(x, z));

/** @param around angle from the tips' direction, anticlockwise as seen from above; @param up angle over the skin; degrees */
function wayAt(around: number, up: number): Way {
	const [a, e] = [MathUtils.degToRad(around), MathUtils.degToRad(up)];
	return [Math.cos(a) * Math.cos(e), Math.sin(a) * Math.cos(e), Math.sin(e)];
}

/** Direction to the lamp in the lean's frame. */
function lampWay({ direction, leaning }: NapState): Way {
	return wayAt(azimuthOf(direction) - leaning, MathUtils.radToDeg(Math.asin(Math.min(direction.y, 1))));
}

/** G of the lamp for the present eye. */
export function factorNow(state: NapState): number {
	const { asset, covers, eye, leaning } = state;
	return factorSeen(asset, covers, lampWay(state), wayAt(eye.azimuth - leaning, eye.elevation));
}

/** Displacement of the tips, share of the length. */
const leanShare = ({ drift, height }: FurAsset) => Math.hypot(...(drift.at(-1) ?? [0, 0])) / height;

/** Direction on a map, whose lower edge is the front. */
const onMap = (azimuth: number) => azimuth - 90;

function paintAround(svg: SVGElement, width: number, height: number, state: NapState): void {
	const { asset, covers, eye, leaning, direction } = state;
	const lamp = lampWay(state);
	drawAround(svg, width, height, {
		factor: (angle) => factorSeen(asset, covers, lamp, wayAt(angle + 90 - leaning, eye.elevation)),
		eye: onMap(eye.azimuth),
		light: onMap(azimuthOf(direction)),
		lean: [onMap(leaning), leanShare(asset)],
	});
}

function paintOver(svg: SVGElement, width: number, height: number, state: NapState, lowest: number): void {
	const { asset, covers, eye, leaning, direction } = state;
	const lamp = lampWay(state);
	const away = eye.azimuth - leaning;
	const level = Math.cos(MathUtils.degToRad(azimuthOf(direction) - eye.azimuth)) * Math.hypot(lamp[0], lamp[1]);
	const factor = (angle: number) =>
		factorSeen(asset, covers, lamp, angle < 90 ? wayAt(away, angle) : wayAt(away + 180, 180 - angle));
	const light = MathUtils.radToDeg(Math.atan2(lamp[2], level));
	drawOver(svg, width, height, { factor, eye: eye.elevation, light, lean: [away, leanShare(asset)] }, lowest);
}

/**
 * Adds both plots and their legend.
 *
 * @param lowest elevation of the eye, degrees
 * @returns function that redraws them
 */
export function napPlots(place: HTMLElement, words: Words['nap'], state: () => NapState, lowest: number): () => void {
	const row = panels(place, 2);
	row.classList.add('plots');
	const plotted = (label: string, name: string, paint: (svg: SVGElement, width: number, height: number) => void) => {
		const box = document.createElement('div');
		row.append(box);
		const plot = new Plot(box, label, 270, paint);
		box.append(Object.assign(document.createElement('p'), { textContent: name }));
		return plot;
	};
	const plots = [
		plotted(words.aroundPlot, words.aroundName, (svg, width, height) => paintAround(svg, width, height, state())),
		plotted(words.overPlot, words.overName, (svg, width, height) => paintOver(svg, width, height, state(), lowest)),
	];
	legend(place, [
		['line', 'ptm', words.curve],
		['line', 'one', words.one],
		['dot', 'bulb', words.lamp],
		['ring', 'watcher', words.eye],
	]);
	return () => {
		for (const plot of plots) plot.redraw();
	};
}
