/** The eye turns around a patch of fur, and the factor of light and eye turns the nap. */

import { type Camera, MathUtils, type Vector2, Vector3 } from 'three';
import { alphaChannel } from '../../fur/reference.ts';
import { directionUnder } from '../../page/aim.ts';
import { lampDistance } from '../../page/lamp/lamp.ts';
import { controlRow, pane, panes, slider } from '../controls.ts';
import { bytesOf } from '../data/above.ts';
import { loadFurry } from '../data/assets.ts';
import { ask } from '../guide/ask.ts';
import type { Lesson, Mount } from '../lesson.ts';
import { coverages } from '../nap/law.ts';
import { napPatches, RADIUS } from '../nap/patches.ts';
import { azimuthOf, factorNow, napPlots } from '../nap/plots.ts';
import { decimal } from '../plot/plot.ts';
import { View, type WindowOptions } from '../view.ts';

const PELT = 'pelt-teddy';
/** Range of the eye's elevation, degrees. */
const [LOWEST, HIGHEST] = [8, 85];
/** Aspect of each picture, width over height. */
const ASPECT = 3 / 2;
/** First eye: opposite the lamp, where the hairs' tips point. */
const FIRST = { around: 0, height: 26 };
/** Turn of the eye by a drag over the whole picture, degrees. */
const SWEEP = 180;
/** Radius around the lamp in which a drag moves it, share of half the picture's height. */
const NEAR = 0.2;

/** Direction to the eye: degrees from the front to the right, and over the ground. */
type Eye = Record<'azimuth' | 'elevation', number>;
type Slider = ReturnType<typeof slider>;

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.nap;
	const { light } = lesson;
	const { fur } = await loadFurry(PELT, lesson);
	const { asset, textures } = fur;
	if (!asset.eye) throw new Error(`models/${PELT}: got no numbers of light and eye, expected those of a bake`);
	const { plane, channel } = alphaChannel(asset.coefficients);
	const covers = coverages(asset, bytesOf(plane ? textures.plane1 : textures.plane0), channel);

	/** Direction of the tips: away from the present lamp. Degrees from the front to the right. */
	const leaning = azimuthOf(light.direction) + 180;
	const eye = { azimuth: leaning + FIRST.around, elevation: FIRST.height };
	const state = () => ({ asset, covers, leaning, direction: light.direction, eye });
	const patches = napPatches(fur, leaning);
	const { scene, captions } = windows(place, lesson, {
		patches,
		eye,
		drag: (pointer, camera) => turn(pointer, camera),
		before: () => show(),
	});

	const [around, height] = sliders(place, lesson, eye, leaning, () => scene.redraw());
	const turn = turnByHand(scene, lesson, around, height);
	const redrawPlots = napPlots(place, words, state, LOWEST);
	const question = lesson.words.ask.nap;
	ask(place, question, () => {
		const factorAt = (from: number) => {
			around.value =
				MathUtils.euclideanModulo(Math.round(azimuthOf(light.direction) + from - leaning) + 180, 360) - 180;
			return factorNow(state());
		};
		const [opposite, beside] = [factorAt(180), factorAt(0)];
		const right = beside > 1 ? 0 : opposite > 1 ? 1 : 2;
		return { right, because: question.because(decimal(beside), decimal(opposite)) };
	});
	/** Update numbers and plots beside the first picture. */
	function show(): void {
		const now = factorNow(state());
		for (const [i, caption] of captions.entries()) {
			const text = words.captions[i]?.(decimal(now)) ?? '';
			if (caption.textContent !== text) caption.textContent = text;
		}
		place.dataset.factor = String(now);
		redrawPlots();
	}
};

/** Pictures of both patches side by side, from one eye. `before` is called before every picture of the first. */
function windows(
	place: HTMLElement,
	lesson: Lesson,
	{
		patches,
		eye,
		drag,
		before,
	}: {
		patches: ReturnType<typeof napPatches>;
		eye: Eye;
		drag: (pointer: Vector2 | undefined, camera: Camera) => void;
		before: () => void;
	},
): { scene: View; captions: HTMLElement[] } {
	const row = panes(place, 2);
	row.classList.add('pair');
	const captions: HTMLElement[] = [];
	let view: View | undefined;
	for (const [i, label] of lesson.words.nap.pictures.entries()) {
		const { element, caption } = pane(row);
		captions.push(caption);
		const options: WindowOptions = {
			label,
			aspect: ASPECT,
			eye,
			zoom: 1.12,
			drag,
			before() {
				for (const [n, patch] of patches.entries()) patch.visible = n === i;
				if (i === 0) before();
			},
		};
		if (view) view.window(element, options);
		else view = new View(element, lesson, { ...options, centre: patches[0].middle, radius: RADIUS });
	}
	const scene = view as View;
	scene.add(...patches);
	return { scene, captions };
}

/** Sliders of the eye, around the fur and over it. */
function sliders(
	place: HTMLElement,
	{ light, words: { nap: words } }: Lesson,
	eye: Eye,
	leaning: number,
	redraw: () => void,
): [around: Slider, height: Slider] {
	const controls = controlRow(place);
	let built = false;
	const move = (change: Partial<Eye>) => {
		Object.assign(eye, change);
		// Stop the drift, which would hide the eye's effect.
		if (built) light.turn(0, 0);
		redraw();
	};
	const around = slider(controls, {
		label: words.around,
		min: -180,
		max: 180,
		step: 1,
		value: FIRST.around,
		text: words.fromLean,
		input: (degrees) => move({ azimuth: leaning + degrees }),
	});
	const height = slider(controls, {
		label: words.height,
		min: LOWEST,
		max: HIGHEST,
		step: 1,
		value: FIRST.height,
		text: words.degrees,
		input: (elevation) => move({ elevation }),
	});
	built = true;
	return [around, height];
}

/** Drags that turn the eye by its sliders, or move the lamp if they begin near it. */
function turnByHand(scene: View, { light }: Lesson, around: Slider, height: Slider) {
	let begun: { x: number; y: number; lamp: boolean; azimuth: number; elevation: number } | undefined;
	const lamp = new Vector3();
	const reach = scene.radius * lampDistance;
	return (pointer: Vector2 | undefined, camera: Camera): void => {
		if (!pointer) {
			begun = undefined;
			return;
		}
		if (!begun) {
			lamp.copy(scene.centre).addScaledVector(light.direction, reach).project(camera);
			const apart = Math.hypot((pointer.x - lamp.x) * ASPECT, pointer.y - lamp.y);
			begun = { x: pointer.x, y: pointer.y, lamp: apart < NEAR, azimuth: around.value, elevation: height.value };
		}
		if (begun.lamp) {
			const { x, y, z } = directionUnder(pointer, camera, scene.centre, reach, lamp);
			light.set(x, y, z);
			return;
		}
		// The fur follows the drag.
		const turned = begun.azimuth - ((pointer.x - begun.x) / 2) * SWEEP;
		around.value = MathUtils.euclideanModulo(Math.round(turned) + 180, 360) - 180;
		height.value = MathUtils.clamp(begun.elevation - ((pointer.y - begun.y) / 2) * 90, LOWEST, HIGHEST);
	};
}
