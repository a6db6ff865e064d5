/** The picture: renderer, lights, backdrop and the one model on show. */

import {
	Color,
	DirectionalLight,
	Group,
	HalfFloatType,
	HemisphereLight,
	NeutralToneMapping,
	type PerspectiveCamera,
	Scene,
	Sphere,
	Vector3,
	WebGLRenderer,
} from 'three';
import { fitShadow } from '../fur/index.ts';
import { backdrop, ContactShadow } from './backdrop.ts';
import type { Environment } from './environments.ts';
import type { Model } from './models.ts';

const maxPixelRatio = 2;

/** Linear colour times irradiance: 2.8π makes a white matt surface facing it 2.8 bright. */
const keyColour = new Color(1, 0.95, 0.87).multiplyScalar(2.8 * Math.PI);

export class Stage {
	readonly renderer: WebGLRenderer;
	readonly scene = new Scene();
	readonly key = new DirectionalLight();
	readonly sky = new HemisphereLight(0xffffff, 0xffffff, 0.7 * Math.PI);
	/** Of the model on show. */
	readonly centre = new Vector3();
	radius = 1;
	model: Model | undefined;
	readonly #shadow = new ContactShadow();
	readonly #backdrop = backdrop();
	/** Light of the place. */
	readonly #around = new Group();
	#environment: Environment | undefined;

	constructor(canvas: HTMLCanvasElement) {
		this.renderer = new WebGLRenderer({
			canvas,
			antialias: false,
			outputBufferType: HalfFloatType,
			powerPreference: 'high-performance',
		});
		this.renderer.toneMapping = NeutralToneMapping;
		this.renderer.shadowMap.enabled = true;
		// One frame is several renders (scene, output): the counts are those of all of them.
		this.renderer.info.autoReset = false;
		this.sky.color.setRGB(0.55, 0.65, 0.8);
		this.sky.groundColor.setRGB(0.28, 0.24, 0.2);
		this.#shadow.visible = false;
		this.scene.add(this.key, this.key.target, this.sky, this.#around, this.#shadow);
		this.surround(undefined);
	}

	/** Puts a model in the place of the one before, which is disposed of. */
	show(model: Model): void {
		if (this.model) {
			this.scene.remove(this.model.object);
			this.model.dispose();
		}
		this.model = model;
		this.scene.add(model.object);
		model.box.getCenter(this.centre);
		this.radius = model.radius;
		this.#shadow.fit(model.box, model.fur?.asset.length ?? 0);
		this.#shadow.visible = true;
		const length = model.fur?.asset.length ?? 0.05 * this.radius;
		this.light(this.key.position.sub(this.centre).normalize());
		fitShadow(this.key, new Sphere(this.centre, this.radius + length), length);
		if (model.fur) {
			model.fur.shells.material.gloss = 0.5;
			model.fur.shells.material.backlight = 6;
		}
	}

	/** @param environment instead of the page's own sky, lamp colour and backdrop; undefined: these */
	surround(environment: Environment | undefined): void {
		this.#environment?.background.dispose();
		this.#environment = environment;
		this.sky.visible = !environment;
		this.key.color.copy(environment?.key.colour ?? keyColour);
		this.scene.background = environment?.background ?? this.#backdrop;
		this.#around.clear();
		if (!environment) return;
		this.#around.add(environment.probe);
		for (const { direction, colour } of environment.others) {
			const lamp = new DirectionalLight(colour);
			lamp.position.copy(direction);
			this.#around.add(lamp);
		}
	}

	/** @param direction unit vector from the model to the lamp, world axes */
	light(direction: Vector3): void {
		this.key.target.position.copy(this.centre);
		this.key.position.copy(this.centre).addScaledVector(direction, 4 * this.radius);
	}

	/** @param width of the window in CSS pixels */
	resize(width: number, height: number): void {
		this.renderer.setPixelRatio(Math.min(devicePixelRatio, maxPixelRatio));
		this.renderer.setSize(width, height, false);
	}

	render(camera: PerspectiveCamera): void {
		this.renderer.info.reset();
		this.renderer.render(this.scene, camera);
	}
}
