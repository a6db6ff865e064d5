/** The picture: renderer, lights, backdrop and the one model on show. */

import {
	Color,
	type DataTexture,
	DirectionalLight,
	Group,
	HalfFloatType,
	HemisphereLight,
	Material,
	Mesh,
	NeutralToneMapping,
	Object3D,
	type PerspectiveCamera,
	Scene,
	Sphere,
	UnsignedByteType,
	Vector3,
	WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import { type Fur, fitShadow, limitsOf, luminance, SmoothEdges, type TextureLimits } from '../fur/index.ts';
import { backdrop, CastShadow, ContactShadow } from '../page/backdrop.ts';
import { disposeAll } from '../page/dispose.ts';
import { Crowd } from './crowd.ts';
import type { Environment } from './environments.ts';
import { Lamps } from './lamps.ts';
import type { Model } from './models.ts';
import { heightOf, stand } from './stand.ts';

const maxPixelRatio = 2;

/** Irradiance: 2.8π makes a white matt surface facing it 2.8 bright. */
const keyPower = 2.8 * Math.PI;
const keyColour = new Color(1, 0.95, 0.87).multiplyScalar(keyPower);

const irradiance = new Vector3();
const sky = new Color();

export class Stage {
	readonly renderer: WebGLRenderer;
	/** A target as the scene's own, for what is made ready beside it. */
	readonly sample: WebGLRenderTarget;
	readonly scene = new Scene();
	readonly key = new DirectionalLight();
	readonly sky = new HemisphereLight(0xffffff, 0xffffff, 0.7 * Math.PI);
	readonly #lamps = new Lamps(keyPower);
	/** Of the model on show. */
	readonly centre = new Vector3();
	radius = 1;
	/** Of one body. */
	closest = 1;
	model: Model | undefined;
	#crowd: Crowd | undefined;
	readonly #edges = new SmoothEdges();
	/** Whether it is done. */
	readonly #smooth: boolean;
	readonly #shadow = new ContactShadow();
	readonly #cast = new CastShadow();
	readonly #backdrop: DataTexture;
	/** Light of the place. */
	readonly #around = new Group();
	#environment: Environment | undefined;
	/** The body's way from its place, world. */
	readonly #offset = new Vector3();
	readonly #towards = new Vector3();
	/** Of the window, CSS pixels. */
	#width = 1;
	#height = 1;
	#scale = 1;

	constructor(canvas: HTMLCanvasElement) {
		const attributes: WebGLContextAttributes = { antialias: false, powerPreference: 'high-performance' };
		// The renderer, which wants to know its output beforehand, is given this same context by the canvas.
		const gl = canvas.getContext('webgl2', attributes) as WebGL2RenderingContext | null;
		const half = gl?.getExtension('EXT_color_buffer_float') ?? gl?.getExtension('EXT_color_buffer_half_float');
		const outputBufferType = half ? HalfFloatType : UnsignedByteType;
		this.renderer = new WebGLRenderer({ canvas, outputBufferType, ...attributes });
		// Effects need a target that is toned at last.
		this.#smooth = Boolean(half);
		if (half) this.renderer.setEffects([this.#edges]);
		this.sample = new WebGLRenderTarget(1, 1, { type: outputBufferType });
		this.renderer.toneMapping = NeutralToneMapping;
		this.renderer.shadowMap.enabled = true;
		// One frame is several renders (scene, output): the counts are those of all of them.
		this.renderer.info.autoReset = false;
		this.sky.color.setRGB(0.55, 0.65, 0.8);
		this.sky.groundColor.setRGB(0.28, 0.24, 0.2);
		this.#backdrop = backdrop(Boolean(half));
		this.#shadow.visible = this.#cast.visible = false;
		this.scene.add(this.key, this.key.target, this.#lamps, this.sky, this.#around, this.#shadow, this.#cast);
		this.surround(undefined);
	}

	/** Puts a model in the place of the one before, which is disposed of; undefined: none. */
	show(model: Model | undefined): void {
		this.#disband();
		if (this.model) {
			this.scene.remove(this.model.object);
			this.model.dispose();
		}
		this.model = model;
		this.#offset.setScalar(0);
		this.#shadow.visible = this.#cast.visible = model !== undefined;
		if (model) this.scene.add(model.object);
	}

	#disband(): void {
		this.#crowd?.dispose();
		this.#crowd = undefined;
	}

	/**
	 * Has so many bodies of the model on show, and sees to it that light and camera take all of them in.
	 *
	 * @param fur that they wear; undefined where there is none, which is alone
	 */
	gather(count: number, fur: Fur | undefined): void {
		const { model } = this;
		if (!model) return;
		if (fur) this.#outline(model.object, fur);
		const many = fur !== undefined && count > 1;
		if (!many || this.#crowd?.fur !== fur) this.#disband();
		if (many && !this.#crowd) {
			this.#crowd = new Crowd(model, fur);
			this.#crowd.pictureHeight = this.renderer.domElement.height;
			this.scene.add(this.#crowd);
		}
		const crowd = this.#crowd;
		if (crowd) crowd.count = count;
		model.object.visible = this.#shadow.visible = this.#cast.visible = !many;
		this.closest = model.radius;
		this.radius = crowd?.radius ?? model.radius;
		model.box.getCenter(this.centre);
		const length = fur?.shells.furLength ?? 0.05 * model.radius;
		this.#shadow.fit(model.box, fur ? length : 0);
		this.#cast.fit(model.box, fur ? length : 0);
		this.#turn();
		fitShadow(this.key, new Sphere(this.centre, (crowd?.reach ?? this.radius) + length), length);
	}

	/** Has eyes, a nose and the like be smooth where hairs stand around them. */
	#outline(object: Object3D, fur: Fur): void {
		if (!this.#smooth) return;
		for (const child of object.children) {
			if (child === fur.skin || child === fur.shells.parent || !(child instanceof Mesh)) continue;
			if (child.material instanceof Material && !child.material.transparent) this.#edges.mark(child.material);
		}
	}

	/**
	 * Moves the one body on show about its foot, and what it brings along: shadow and the light's own view of it.
	 *
	 * @param offset from its place, in radii of the body
	 * @param yaw turn about the upright axis, radians
	 */
	place(offset: Vector3, yaw: number): void {
		const { model } = this;
		if (!model) return;
		this.#offset.copy(offset).multiplyScalar(model.radius);
		stand(model, this.#offset, yaw);
		this.#shadow.follow(this.#offset, yaw, heightOf(model));
		this.#turn();
	}

	/** The lamp goes along with the body. */
	#turn(): void {
		this.light(this.#towards.subVectors(this.key.position, this.key.target.position).normalize());
	}

	/** @param environment instead of the page's own sky, lamp colour and backdrop; undefined: these */
	surround(environment: Environment | undefined): void {
		this.#environment?.background.dispose();
		this.#environment = environment;
		this.sky.visible = !environment;
		this.key.color.copy(environment?.key.colour ?? keyColour);
		this.scene.background = environment?.background ?? this.#backdrop;
		this.#around.clear();
		if (environment) this.#around.add(environment.probe);
		for (const { direction, colour } of environment?.others ?? []) {
			const lamp = new DirectionalLight(colour);
			lamp.position.copy(direction);
			this.#around.add(lamp);
		}
		this.#turn();
	}

	/** @param direction unit vector from the model to the lamp, world axes */
	light(direction: Vector3): void {
		const target = this.key.target.position.copy(this.centre).add(this.#offset);
		this.key.position.copy(target).addScaledVector(direction, 4 * this.radius);
		this.#lamps.turn(direction);
		this.#cast.follow(target, this.radius, direction, this.#shareOnGround(direction.y));
	}

	/** The dragged lamp's share in the light on the ground. @param sine of its elevation */
	#shareOnGround(sine: number): number {
		const lamp = luminance(this.key.color) * this.key.intensity * Math.max(sine, 0);
		const { probe } = this.#environment ?? {};
		if (probe) sky.setRGB(...probe.sh.getIrradianceAt(Object3D.DEFAULT_UP, irradiance).toArray());
		else sky.copy(this.sky.color).multiplyScalar(this.sky.intensity);
		return lamp / Math.max(lamp + luminance(sky), 1e-6);
	}

	/** Lamps in all, 1 to 8: the one that is dragged and those around it. */
	set lamps(count: number) {
		this.#lamps.lit = count;
		this.key.intensity = this.#lamps.share;
	}

	get gl(): WebGL2RenderingContext {
		return this.renderer.getContext() as WebGL2RenderingContext;
	}

	get limits(): TextureLimits {
		return limitsOf(this.gl);
	}

	/** @param width of the window in CSS pixels */
	resize(width: number, height: number): void {
		this.#width = width;
		this.#height = height;
		this.#size();
	}

	/** Share of the resolution per side that is drawn. */
	get scale(): number {
		return this.#scale;
	}

	set scale(scale: number) {
		if (scale === this.#scale) return;
		this.#scale = scale;
		this.#size();
	}

	#size(): void {
		const ratio = Math.min(devicePixelRatio, maxPixelRatio) * this.#scale;
		// A pixel is left of the narrowest window.
		this.renderer.setPixelRatio(Math.max(ratio, 1 / Math.min(this.#width, this.#height)));
		this.renderer.setSize(this.#width, this.#height, false);
		if (this.#crowd) this.#crowd.pictureHeight = this.renderer.domElement.height;
	}

	/** To be called while the context is lost: three would later ask the new one to delete what belonged to the old one. */
	forget(): void {
		disposeAll(this.scene);
		this.key.shadow.dispose();
		// The targets of the output go when their size changes.
		this.renderer.setSize(1, 1, false);
		this.#size();
	}

	render(camera: PerspectiveCamera): void {
		if (this.gl.isContextLost()) return;
		this.renderer.info.reset();
		this.renderer.render(this.scene, camera);
	}
}
