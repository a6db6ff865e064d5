/** Three-dimensional figure: a scene under the lesson's light, with one or more windows of fixed cameras. */

import {
	type Camera,
	DirectionalLight,
	MathUtils,
	Object3D,
	PerspectiveCamera,
	Scene,
	Sphere,
	type Vector2,
	Vector3,
} from 'three';
import { fitFurShadow } from '../fur/index.ts';
import { backdrop } from '../page/backdrop.ts';
import { daylightSky, KEY_COLOUR } from '../page/daylight.ts';
import { Lamp, lampDistance } from '../page/lamp/lamp.ts';
import { LampLines } from '../page/lamp/lines.ts';
import { listenToDrags } from '../scene/drag.ts';
import type { Picture } from '../scene/Painter.ts';
import { figureCanvas } from './controls.ts';
import { lightByHand, lightByKeys } from './drag.ts';
import type { Lesson } from './lesson.ts';

/** Vertical field of view, degrees. */
export const FIELD_OF_VIEW = 24;
/** Size of the window over the lamp's sphere, for the lamp's halo. */
const ROOM = 1.06;

export interface WindowOptions {
	/** Accessible name. */
	label: string;
	/** Width over height. */
	aspect?: number;
	/** Camera: degrees to the right of the front and above the ground. */
	azimuth?: number;
	elevation?: number;
	/** Moving camera: read before every picture. */
	eye?: Readonly<{ azimuth: number; elevation: number }>;
	/** Zoom over the view of the lamp's whole sphere. */
	zoom?: number;
	/** Distance of the eye in place of the zoom, radii. */
	distance?: number;
	/** Middle of the picture; the lamp's centre by default. */
	target?: Vector3;
	/** Whether the lamp is shown and can be dragged. */
	lamp?: boolean;
	/** Turn of the lamp about the upright axis against other windows, degrees. */
	turn?: number;
	/** Drags instead of moving the lamp, which arrow keys still do; `pointer` is undefined at a drag's end. */
	drag?: (pointer: Vector2 | undefined, camera: Camera) => void;
	/** Called before every picture of this window, with the light where it will be. */
	before?: () => void;
}

export interface ViewOptions extends WindowOptions {
	/** Centre of the lamp's sphere. */
	centre?: Vector3;
	radius?: number;
}

/**
 * Distance of the eye, radii, at which a picture shows the lamp's sphere.
 *
 * @param aspect width over height; @param zoom as far as a lamp to be dragged stays within the picture's width
 */
export function distanceFor(aspect: number, zoom: number, lamp = true): number {
	const half = Math.tan(MathUtils.degToRad(FIELD_OF_VIEW / 2));
	const filled = (width: number) => (lampDistance * ROOM) / Math.sin(Math.atan(half * width));
	const near = filled(Math.min(1, aspect)) / zoom;
	return lamp ? Math.max(near, filled(aspect)) : near;
}

export class View {
	/** Canvas of the first window. */
	readonly canvas: HTMLCanvasElement;
	readonly scene = new Scene();
	readonly key = new DirectionalLight(KEY_COLOUR);
	readonly sky = daylightSky();
	readonly centre: Vector3;
	readonly radius: number;
	readonly #lesson: Lesson;
	readonly #lamp = new Lamp();
	readonly #windows: Picture[] = [];
	readonly #here = new Vector3();
	readonly #toCamera = new Vector3();

	/** @throws Error for the reader without WebGL2 */
	constructor(place: HTMLElement, lesson: Lesson, { centre, radius, ...options }: ViewOptions) {
		if (!lesson.painter.renderer) throw new Error(lesson.words.needsWebGL2);
		this.#lesson = lesson;
		this.centre = centre ?? new Vector3();
		this.radius = radius ?? 1;
		this.scene.background = backdrop(true);
		this.scene.add(this.key, this.key.target, this.sky, this.#lamp);
		this.#lamp.addLines(new LampLines());
		this.canvas = this.window(place, options);
		lesson.light.listen(() => this.redraw());
	}

	/** Opens a window on the scene. @returns its canvas */
	window(place: HTMLElement, options: WindowOptions): HTMLCanvasElement {
		const { label, aspect = 16 / 10, lamp = true, turn = 0, drag, before } = options;
		const canvas = figureCanvas(place, label, aspect);
		canvas.classList.add('scene');
		const camera = new PerspectiveCamera(FIELD_OF_VIEW);
		const { painter, light } = this.#lesson;
		const picture = painter.picture(canvas, () => {
			this.#aim(camera, canvas.width / canvas.height, options);
			this.#shine(this.#here.copy(light.direction).applyAxisAngle(Object3D.DEFAULT_UP, MathUtils.degToRad(turn)));
			this.#lamp.visible = lamp;
			this.#lamp.glide(camera, Number.POSITIVE_INFINITY);
			before?.();
			painter.render(this.scene, camera, canvas);
		});
		this.#windows.push(picture);
		if (drag) {
			listenToDrags(
				canvas,
				(pointer) => drag(pointer, camera),
				() => drag(undefined, camera),
			);
			lightByKeys(canvas, light);
		} else lightByHand(canvas, light, camera, this.centre, this.radius * lampDistance, MathUtils.degToRad(turn));
		return canvas;
	}

	#shine(direction: Vector3): void {
		this.key.target.position.copy(this.centre);
		this.key.position.copy(this.centre).addScaledVector(direction, 4 * this.radius);
		this.#lamp.place(direction, this.centre, this.radius);
	}

	add(...objects: Object3D[]): void {
		this.scene.add(...objects);
		this.redraw();
	}

	/** Whether any of its windows is on screen, or nearly. */
	get visible(): boolean {
		return this.#windows.some(({ visible }) => visible);
	}

	redraw(): void {
		for (const picture of this.#windows) picture.redraw();
	}

	/** Lets the key light cast shadows. @param softness width of their edges, world units; @param reach radius of the casters */
	cast(softness: number, reach = this.radius): void {
		this.#shine(this.#here.copy(this.#lesson.light.direction));
		fitFurShadow(this.key, new Sphere(this.centre, reach), softness);
		const { shadow } = this.key;
		shadow.radius = (softness * shadow.mapSize.x) / (2 * reach);
	}

	#aim(
		camera: PerspectiveCamera,
		aspect: number,
		{ eye, azimuth = eye?.azimuth ?? 0, elevation = eye?.elevation ?? 20, zoom = 1, ...options }: WindowOptions,
	): void {
		const { distance, target, lamp = true } = options;
		camera.aspect = aspect;
		const away = this.radius * (distance ?? distanceFor(aspect, zoom, lamp));
		this.#toCamera.setFromSphericalCoords(away, MathUtils.degToRad(90 - elevation), MathUtils.degToRad(azimuth));
		camera.position.copy(target ?? this.centre).add(this.#toCamera);
		camera.near = Math.max(away - 2.5 * this.radius, 0.02 * away);
		camera.far = away + 4 * this.radius;
		camera.lookAt(target ?? this.centre);
		camera.updateProjectionMatrix();
		camera.updateMatrixWorld();
	}
}
