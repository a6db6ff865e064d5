/** Step 8: the eye turns around a patch of fur, and the factor of light and eye turns the nap. */

import {
	type Camera,
	CircleGeometry,
	Float32BufferAttribute,
	MathUtils,
	type PlaneGeometry,
	type Vector2,
	Vector3,
} from 'three';
import { alphaChannel, type FurAsset } from '../../fur/index.ts';
import { directionUnder } from '../../page/aim.ts';
import { lampDistance } from '../../page/lamp.ts';
import { bytesOf } from '../above.ts';
import { loadFurry } from '../assets.ts';
import { controlRow, pane, panes, slider } from '../controls.ts';
import type { Mount } from '../lesson.ts';
import { decimal, legend, Plot } from '../measured/plot.ts';
import { panels } from '../measured/slice.ts';
import { coverages, factorSeen, type Way } from '../nap/law.ts';
import { drawAround, drawOver, type Polar } from '../nap/polar.ts';
import { FurPatch, tiled } from '../patch.ts';
import { View, type WindowOptions } from '../view.ts';

const PELT = 'pelt-teddy';
const TILES = 4;
/** Squares of its mesh across: its rim is round. */
const CELLS = 48;
/** Of the patch. */
const RADIUS = TILES / 2;
/** Share of it over which the fur thins out and grows shorter. */
const RIM = 0.12;
/** How low and how high the eye may stand, degrees. */
const [LOWEST, HIGHEST] = [8, 85];
/** Of each picture, width over height. */
const ASPECT = 3 / 2;
/** The eye at first: against the lamp, where the hairs' tips point. */
const FIRST = { around: 0, height: 26 };
/** Degrees that a drag over the whole picture turns the eye. */
const SWEEP = 180;
/** How near to the lamp a drag begins that moves it, share of half the picture's height. */
const NEAR = 0.2;

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.nap;
	const { light } = lesson;
	const { fur } = await loadFurry(PELT, lesson);
	const { asset, textures } = fur;
	if (!asset.eye) throw new Error(`models/${PELT}: got no numbers of light and eye, expected those of a bake`);
	const { plane, channel } = alphaChannel(asset.coefficients);
	const covers = coverages(asset, bytesOf(plane ? textures.plane1 : textures.plane0), channel);

	// The second one's texels are seen from anywhere as from straight above.
	const { eye: _, surge: __, ...plain } = asset;
	const { pelt, ground } = fur;
	const patches = [asset, plain].map((each) => new FurPatch({ asset: each, pelt, ground }, TILES, rounded()));
	const first = azimuthOf(light.direction);
	/** Where the tips point: away from the lamp as it stands now. Degrees from the front to the right. */
	const leaning = first + 180;
	for (const patch of patches) {
		patch.rotation.y = MathUtils.degToRad(leaning - 90) - leanOnTile(asset);
		patch.skin.geometry.dispose();
		patch.skin.geometry = new CircleGeometry(RADIUS * (1 - RIM / 2), 64).rotateX(-Math.PI / 2);
	}

	const eye = { azimuth: leaning + FIRST.around, elevation: FIRST.height };
	const [main] = patches as [FurPatch];
	const row = panes(place, 2);
	row.classList.add('pair');
	const captions: HTMLElement[] = [];
	let view: View | undefined;
	for (const [i, label] of words.pictures.entries()) {
		const { element, caption } = pane(row);
		captions.push(caption);
		const options: WindowOptions = {
			label,
			aspect: ASPECT,
			eye,
			zoom: 1.12,
			drag: turn,
			before() {
				for (const [n, patch] of patches.entries()) patch.visible = n === i;
				if (i === 0) show();
			},
		};
		if (view) view.window(element, options);
		else view = new View(element, lesson, { ...options, centre: main.middle, radius: RADIUS });
	}
	const scene = view as View;
	scene.add(...patches);

	const controls = controlRow(place);
	let built = false;
	const moved = (change: Partial<typeof eye>) => {
		Object.assign(eye, change);
		// A lamp that drifts would hide what the eye does.
		if (built) light.turn(0, 0);
		scene.redraw();
	};
	const around = slider(controls, {
		label: words.around,
		min: -180,
		max: 180,
		step: 1,
		value: FIRST.around,
		text: words.degrees,
		input: (degrees) => moved({ azimuth: leaning + degrees }),
	});
	const height = slider(controls, {
		label: words.height,
		min: LOWEST,
		max: HIGHEST,
		step: 1,
		value: FIRST.height,
		text: words.degrees,
		input: (elevation) => moved({ elevation }),
	});
	built = true;

	const plots = panels(place, 2);
	plots.classList.add('plots');
	const shown = () => {
		const [l, v] = [wayOf(light.direction), wayAt(eye.azimuth - leaning, eye.elevation)];
		return { l, v, now: factorSeen(asset, covers, l, v) };
	};
	const plotted = (label: string, name: string, paint: (svg: SVGElement, width: number, height: number) => void) => {
		const box = document.createElement('div');
		plots.append(box);
		const plot = new Plot(box, label, 270, paint);
		box.append(Object.assign(document.createElement('p'), { textContent: name }));
		return plot;
	};
	const share = Math.hypot(...(asset.drift.at(-1) ?? [0, 0])) / asset.height;
	const both = [
		plotted(words.aroundPlot, words.aroundName, (svg, width, tall) => {
			const { l } = shown();
			// Front is below, as on a map of what lies before the reader.
			const onMap = (azimuth: number) => azimuth - 90;
			const factor = (angle: number) => factorSeen(asset, covers, l, wayAt(angle + 90 - leaning, eye.elevation));
			const turned: Polar = {
				factor,
				eye: onMap(eye.azimuth),
				light: onMap(azimuthOf(light.direction)),
				lean: [onMap(leaning), share],
			};
			drawAround(svg, width, tall, turned);
		}),
		plotted(words.overPlot, words.overName, (svg, width, tall) => {
			const { l } = shown();
			const away = eye.azimuth - leaning;
			const factor = (angle: number) =>
				factorSeen(asset, covers, l, angle < 90 ? wayAt(away, angle) : wayAt(away + 180, 180 - angle));
			const level = Math.cos(MathUtils.degToRad(azimuthOf(light.direction) - eye.azimuth)) * Math.hypot(l[0], l[1]);
			const cut: Polar = {
				factor,
				eye: eye.elevation,
				light: MathUtils.radToDeg(Math.atan2(l[2], level)),
				lean: [away, share],
			};
			drawOver(svg, width, tall, cut, LOWEST);
		}),
	];
	legend(place, [
		['line', 'ptm', words.curve],
		['line', 'one', words.one],
		['dot', 'bulb', words.lamp],
		['ring', 'watcher', words.eye],
	]);

	/** All that goes with the first picture. */
	function show(): void {
		const { now } = shown();
		for (const [i, caption] of captions.entries()) {
			const text = words.captions[i]?.(decimal(now)) ?? '';
			if (caption.textContent !== text) caption.textContent = text;
		}
		place.dataset.factor = String(now);
		for (const plot of both) plot.redraw();
	}

	let begun: { x: number; y: number; lamp: boolean; azimuth: number; elevation: number } | undefined;
	const lamp = new Vector3();
	function turn(pointer: Vector2 | undefined, camera: Camera): void {
		if (!pointer) {
			begun = undefined;
			return;
		}
		if (!begun) {
			lamp
				.copy(scene.centre)
				.addScaledVector(light.direction, scene.radius * lampDistance)
				.project(camera);
			const apart = Math.hypot((pointer.x - lamp.x) * ASPECT, pointer.y - lamp.y);
			begun = { x: pointer.x, y: pointer.y, lamp: apart < NEAR, azimuth: around.value, elevation: height.value };
		}
		if (begun.lamp) {
			const { x, y, z } = directionUnder(pointer, camera, scene.centre, scene.radius * lampDistance, lamp);
			light.set(x, y, z);
			return;
		}
		// The fur follows the hand.
		const turned = begun.azimuth - ((pointer.x - begun.x) / 2) * SWEEP;
		around.value = MathUtils.euclideanModulo(Math.round(turned) + 180, 360) - 180;
		height.value = MathUtils.clamp(begun.elevation - ((pointer.y - begun.y) / 2) * 90, LOWEST, HIGHEST);
	}

	/** A world direction in the lean's frame. */
	function wayOf(direction: Readonly<Vector3>): Way {
		return wayAt(azimuthOf(direction) - leaning, MathUtils.radToDeg(Math.asin(Math.min(direction.y, 1))));
	}
};

/** A square of tiles on which fur grows in a disc. */
function rounded(): PlaneGeometry {
	const surface = tiled(TILES, CELLS);
	const position = surface.getAttribute('position');
	const mask: number[] = [];
	for (let i = 0; i < position.count; i++) {
		const away = Math.hypot(position.getX(i), position.getZ(i)) / RADIUS;
		const dense = MathUtils.smoothstep(1 - away, 0, RIM);
		mask.push(dense, 0.4 + 0.6 * dense, 1, 0);
	}
	return surface.setAttribute('_fur', new Float32BufferAttribute(mask, 4));
}

/** Degrees from the front to the right. */
const azimuthOf = ({ x, z }: Readonly<Vector3>): number => MathUtils.radToDeg(Math.atan2(x, z));

/** @param around from where the tips point, anticlockwise as seen from above; @param up over the skin; degrees */
function wayAt(around: number, up: number): Way {
	const [a, e] = [MathUtils.degToRad(around), MathUtils.degToRad(up)];
	return [Math.cos(a) * Math.cos(e), Math.sin(a) * Math.cos(e), Math.sin(e)];
}

/** Where the tips point on the tile, radians from u to v. */
function leanOnTile({ drift }: Pick<FurAsset, 'drift'>): number {
	const [u, v] = drift.at(-1) ?? [0, 1];
	return Math.atan2(v, u);
}
