/** A three-dimensional figure: a scene under the lesson's light, and one window on it or several, whose cameras stay. */

import {
	type Camera,
	Color,
	DirectionalLight,
	HemisphereLight,
	MathUtils,
	Object3D,
	PerspectiveCamera,
	Scene,
	Sphere,
	type Vector2,
	Vector3,
} from 'three';
import { fitShadow } from '../fur/index.ts';
import { backdrop } from '../page/backdrop.ts';
import { Lamp, lampDistance } from '../page/lamp.ts';
import { figureCanvas } from './controls.ts';
import { lightByHand, lightByKeys, listenToDrags } from './drag.ts';
import type { Lesson } from './lesson.ts';
import type { Picture } from './painter.ts';

/** Degrees. */
const FIELD_OF_VIEW = 24;
/** Of the window over the sphere on which the lamp rides, for its halo. */
const ROOM = 1.06;

const keyColour = new Color(1, 0.95, 0.87).multiplyScalar(2.8 * Math.PI);

export interface WindowOptions {
	/** For those who cannot see it. */
	label: string;
	/** Width over height. */
	aspect?: number;
	/** Where the camera stands: degrees to the right of the front and above the ground. */
	azimuth?: number;
	elevation?: number;
	/** The same where the camera moves: read before every picture. */
	eye?: Readonly<{ azimuth: number; elevation: number }>;
	/** How much nearer than where the whole sphere of the lamp is in the picture. */
	zoom?: number;
	/** What is in the middle of the picture; else what the lamp turns about. */
	target?: Vector3;
	/** Whether the lamp is in the picture, and moved by hand there. */
	lamp?: boolean;
	/** Degrees by which the lamp stands further about the upright axis in this window than in others. */
	turn?: number;
	/** What drags do here instead of moving the lamp, which is left to arrow keys; `pointer` is undefined when one ends. */
	drag?: (pointer: Vector2 | undefined, camera: Camera) => void;
	/** Called before every picture of this window, with the light where it will be. */
	before?: () => void;
}

export interface ViewOptions extends WindowOptions {
	/** What is looked at; the lamp rides on a sphere around it. */
	centre?: Vector3;
	radius?: number;
}

export class View {
	/** Of the first window. */
	readonly canvas: HTMLCanvasElement;
	readonly scene = new Scene();
	readonly key = new DirectionalLight(keyColour);
	readonly sky = new HemisphereLight(new Color(0.55, 0.65, 0.8), new Color(0.28, 0.24, 0.2), 0.7 * Math.PI);
	readonly centre: Vector3;
	readonly radius: number;
	readonly #lesson: Lesson;
	readonly #lamp = new Lamp();
	readonly #windows: Picture[] = [];
	readonly #here = new Vector3();
	readonly #toCamera = new Vector3();

	/** @throws Error for the reader where there is no WebGL2 */
	constructor(place: HTMLElement, lesson: Lesson, { centre, radius, ...options }: ViewOptions) {
		if (!lesson.painter.renderer) throw new Error(lesson.words.needsWebGL2);
		this.#lesson = lesson;
		this.centre = centre ?? new Vector3();
		this.radius = radius ?? 1;
		this.scene.background = backdrop(true);
		this.scene.add(this.key, this.key.target, this.sky, this.#lamp);
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

	/** The key light casts shadows. @param softness of their edges, world units; @param reach radius of what casts them */
	cast(softness: number, reach = this.radius): void {
		this.#shine(this.#here.copy(this.#lesson.light.direction));
		fitShadow(this.key, new Sphere(this.centre, reach), softness);
		const { shadow } = this.key;
		shadow.radius = (softness * shadow.mapSize.x) / (2 * reach);
	}

	#aim(
		camera: PerspectiveCamera,
		aspect: number,
		{ eye, azimuth = eye?.azimuth ?? 0, elevation = eye?.elevation ?? 20, zoom = 1, target }: WindowOptions,
	): void {
		camera.aspect = aspect;
		const half = Math.tan(MathUtils.degToRad(FIELD_OF_VIEW / 2)) * Math.min(1, aspect);
		const away = (this.radius * lampDistance * ROOM) / (zoom * Math.sin(Math.atan(half)));
		this.#toCamera.setFromSphericalCoords(away, MathUtils.degToRad(90 - elevation), MathUtils.degToRad(azimuth));
		camera.position.copy(target ?? this.centre).add(this.#toCamera);
		camera.near = Math.max(away - 2.5 * this.radius, 0.02 * away);
		camera.far = away + 4 * this.radius;
		camera.lookAt(target ?? this.centre);
		camera.updateProjectionMatrix();
		camera.updateMatrixWorld();
	}
}
