/** A three-dimensional figure: a canvas, a scene under the lesson's light, and a camera that stays where it is. */

import {
	Color,
	DirectionalLight,
	HemisphereLight,
	MathUtils,
	type Object3D,
	PerspectiveCamera,
	Scene,
	Sphere,
	Vector3,
} from 'three';
import { type Fur, fitShadow } from '../fur/index.ts';
import { backdrop } from '../page/backdrop.ts';
import { Lamp, lampDistance } from '../page/lamp.ts';
import { figureCanvas } from './controls.ts';
import { lightByHand } from './drag.ts';
import type { Lesson } from './lesson.ts';
import type { Picture } from './painter.ts';

/** Degrees. */
const FIELD_OF_VIEW = 24;
/** Of the window over the sphere that is looked at, the lamp and its halo. */
const ROOM = 1.06;

const keyColour = new Color(1, 0.95, 0.87).multiplyScalar(2.8 * Math.PI);

export interface ViewOptions {
	/** For those who cannot see it. */
	label: string;
	/** Width over height. */
	aspect?: number;
	/** Where the camera stands: degrees to the right of the front and above the ground. */
	azimuth?: number;
	elevation?: number;
	/** What is looked at; the lamp rides on a sphere around it. */
	centre?: Vector3;
	radius?: number;
	/** Whether the lamp is in the picture, and moved by hand there; true by default. */
	lamp?: boolean;
}

export class View {
	readonly canvas: HTMLCanvasElement;
	readonly scene = new Scene();
	readonly camera = new PerspectiveCamera(FIELD_OF_VIEW);
	readonly key = new DirectionalLight(keyColour);
	readonly sky = new HemisphereLight(new Color(0.55, 0.65, 0.8), new Color(0.28, 0.24, 0.2), 0.7 * Math.PI);
	readonly centre: Vector3;
	readonly radius: number;
	/** Called before every picture, with the light where it will be. */
	before: (() => void) | undefined;
	readonly #lamp = new Lamp();
	readonly #picture: Picture;
	readonly #toCamera = new Vector3();
	#azimuth: number;
	#elevation: number;
	#shadow: { sphere: Sphere; length: number } | undefined;

	/** @throws Error for the reader where there is no WebGL2 */
	constructor(place: HTMLElement, { painter, light, words }: Lesson, options: ViewOptions) {
		if (!painter.renderer) throw new Error(words.needsWebGL2);
		const { label, aspect = 16 / 10, azimuth = 0, elevation = 20 } = options;
		this.canvas = figureCanvas(place, label, aspect);
		this.canvas.classList.add('scene');
		this.centre = options.centre ?? new Vector3();
		this.radius = options.radius ?? 1;
		this.#azimuth = azimuth;
		this.#elevation = elevation;
		this.scene.background = backdrop(true);
		this.#lamp.visible = options.lamp ?? true;
		this.scene.add(this.key, this.key.target, this.sky, this.#lamp);
		this.#picture = painter.picture(this.canvas, () => {
			this.#frame();
			this.before?.();
			painter.render(this.scene, this.camera, this.canvas);
		});
		light.listen((direction) => {
			this.key.target.position.copy(this.centre);
			this.key.position.copy(this.centre).addScaledVector(direction, 4 * this.radius);
			this.#lamp.place(direction, this.centre, this.radius);
			this.redraw();
		});
		if (this.#lamp.visible) lightByHand(this.canvas, light, this.camera, this.centre, this.radius * lampDistance);
	}

	add(...objects: Object3D[]): void {
		this.scene.add(...objects);
		this.redraw();
	}

	redraw(): void {
		this.#picture.redraw();
	}

	/** Turns the camera about what it looks at; degrees. */
	look(azimuth: number, elevation: number): void {
		this.#azimuth = azimuth;
		this.#elevation = elevation;
		this.redraw();
	}

	/** The key light casts the shadow of a furry body. @param reach radius of what casts and catches it */
	cast(fur: Fur, reach = this.radius): void {
		this.#shadow = { sphere: new Sphere(this.centre, reach + fur.asset.length), length: fur.asset.length };
		fitShadow(this.key, this.#shadow.sphere, this.#shadow.length);
	}

	/** Puts the camera where the sphere of the lamp fits into the picture. */
	#frame(): void {
		const { camera, canvas } = this;
		camera.aspect = canvas.width / canvas.height;
		const half = MathUtils.degToRad(FIELD_OF_VIEW / 2);
		const narrow = Math.min(1, camera.aspect);
		const away = (this.radius * lampDistance * ROOM) / Math.sin(Math.atan(Math.tan(half) * narrow));
		this.#toCamera.setFromSphericalCoords(
			away,
			MathUtils.degToRad(90 - this.#elevation),
			MathUtils.degToRad(this.#azimuth),
		);
		camera.position.copy(this.centre).add(this.#toCamera);
		camera.near = away - 2 * this.radius;
		camera.far = away + 4 * this.radius;
		camera.lookAt(this.centre);
		camera.updateProjectionMatrix();
		camera.updateMatrixWorld();
		this.#lamp.glide(camera, Number.POSITIVE_INFINITY);
	}
}
