/** Stage: renderer, lights, backdrop and the model on show. */

import {
	Box3,
	type DataTexture,
	DirectionalLight,
	Group,
	HalfFloatType,
	Material,
	type Object3D,
	type PerspectiveCamera,
	Scene,
	Sphere,
	UnsignedByteType,
	Vector3,
	WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import { type Fur, FurEdgeEffect, type FurLimits, fitFurShadow, furLimits } from '../../fur/index.ts';
import { backdrop } from '../../page/backdrop.ts';
import { daylightSky, KEY_COLOUR, KEY_POWER } from '../../page/daylight.ts';
import { disposeAll } from '../../page/dispose.ts';
import { ContactShadow, Ground, SLATE } from '../../page/ground.ts';
import { setToneMapping } from '../../page/toneMapping.ts';
import type { Environment } from '../../scene/environment.ts';
import { footing } from '../../scene/footing.ts';
import { features, type Model } from '../../scene/model.ts';
import type { Crowd } from './crowd.ts';
import { Lamps } from './lamps.ts';
import { heightOf, stand } from './stand.ts';

const MAX_PIXEL_RATIO = 2;

/** Radius of the ground, in radii of the body or of the crowd that stands on it. */
const ROOM = { body: 6, crowd: 2.5 };

export class Stage {
	readonly renderer: WebGLRenderer;
	/** Target in the scene's own format, for materials that are compiled beside it. */
	readonly sample: WebGLRenderTarget;
	readonly scene = new Scene();
	readonly key = new DirectionalLight();
	readonly sky = daylightSky();
	readonly #lamps = new Lamps(KEY_POWER);
	/** Centre and radius of what is on show. */
	readonly centre = new Vector3();
	radius = 1;
	/** Radius of one body, in a crowd too, and its longest hairs, as they were baked. */
	bodyRadius = 1;
	furLength = 0;
	model: Model | undefined;
	/** True once centre and radius have changed by themselves; who frames them sets it back. */
	reframed = false;
	#crowd: Crowd | undefined;
	readonly #edges = new FurEdgeEffect();
	/** True where the renderer can smooth edges. */
	readonly #smooth: boolean;
	readonly #shadow = new ContactShadow();
	readonly #ground = new Ground();
	readonly #backdrop: DataTexture;
	/** Lights of the environment. */
	readonly #environmentLights = new Group();
	#environment: Environment | undefined;
	/** Offset of the body from its place, world, and turn about the upright axis, radians. */
	readonly #offset = new Vector3();
	#yaw = 0;
	/** Box around the body in its pose, at its place in the file. */
	readonly #pose = new Box3();
	readonly #lift = new Vector3();
	#fur: Fur | undefined;
	readonly #toLamp = new Vector3();
	/** Size of the window, CSS pixels. */
	#width = 1;
	#height = 1;
	#scale = 1;

	constructor(canvas: HTMLCanvasElement) {
		const attributes: WebGLContextAttributes = { antialias: false, powerPreference: 'high-performance' };
		// The renderer needs its output type beforehand; the canvas gives it this same context.
		const gl = canvas.getContext('webgl2', attributes) as WebGL2RenderingContext | null;
		const half = gl?.getExtension('EXT_color_buffer_float') ?? gl?.getExtension('EXT_color_buffer_half_float');
		const outputBufferType = half ? HalfFloatType : UnsignedByteType;
		this.renderer = new WebGLRenderer({ canvas, outputBufferType, ...attributes });
		// Effects need a target that is tone mapped last.
		this.#smooth = Boolean(half);
		if (half) this.renderer.setEffects([this.#edges]);
		this.sample = new WebGLRenderTarget(1, 1, { type: outputBufferType });
		setToneMapping(this.renderer);
		this.renderer.shadowMap.enabled = true;
		// A frame is several renders (scene, output): counts add up over them.
		this.renderer.info.autoReset = false;
		this.#backdrop = backdrop(Boolean(half));
		this.#shadow.visible = this.#ground.visible = false;
		this.scene.add(this.key, this.key.target, this.#lamps, this.sky, this.#environmentLights);
		this.scene.add(this.#shadow, this.#ground);
		this.setEnvironment(undefined);
	}

	/** Shows a model instead of the one before, which is disposed of; undefined shows none. */
	setModel(model: Model | undefined): void {
		this.#clearCrowd();
		if (this.model) {
			this.scene.remove(this.model.object);
			this.model.dispose();
		}
		this.model = model;
		this.#offset.setScalar(0);
		this.#yaw = 0;
		this.#shadow.visible = this.#ground.visible = model !== undefined;
		if (model) this.scene.add(model.object);
	}

	#clearCrowd(): void {
		this.#crowd?.dispose();
		this.#crowd = undefined;
	}

	/**
	 * Shows that many bodies of the model, and fits light and camera to all of them.
	 *
	 * @param fur of the bodies; a model without fur stands alone
	 * @param Made what shows crowds; one body without it
	 */
	setCrowd(count: number, fur: Fur | undefined, Made?: typeof Crowd): void {
		const { model } = this;
		if (!model) return;
		if (fur) this.#smoothOutlines(model.object, fur);
		const many = fur && Made && count > 1;
		if (!many || this.#crowd?.fur !== fur) this.#clearCrowd();
		if (many && !this.#crowd) {
			this.#crowd = new Made(model, fur);
			this.#crowd.pictureHeight = this.renderer.domElement.height;
			this.scene.add(this.#crowd);
		}
		if (this.#crowd) this.#crowd.count = count;
		model.object.visible = this.#shadow.visible = !many;
		this.#fur = fur;
		this.#frame(model);
		this.followPose();
	}

	/** Fits light and camera to what is on show. */
	#frame(model: Model): void {
		this.bodyRadius = model.radius;
		this.furLength = this.#fur?.asset.length ?? 0;
		this.radius = this.#crowd?.radius ?? model.radius;
		model.box.getCenter(this.centre);
		const length = this.#fur?.shells.furLength ?? 0.05 * model.radius;
		this.setLight(this.toLamp);
		fitFurShadow(this.key, new Sphere(this.centre, (this.#crowd?.reach ?? this.radius) + length), length);
	}

	/** Fits the ground, and the soft shadow on it, to the pose of the body; call after a step of its clip. */
	followPose(): void {
		const { model } = this;
		const fur = this.#fur;
		if (!model) return;
		// One clip needs other room than another.
		if (model.radius !== this.bodyRadius || !model.box.getCenter(this.#lift).equals(this.centre)) {
			this.#frame(model);
			this.reframed = true;
		}
		const ground = footing({ ...model, fur });
		if (model.clips) this.#crowd?.pose(model.clips);
		if (model.clips) model.clips.poseBox(this.#pose);
		else this.#pose.copy(model.box);
		this.#shadow.fit(this.#pose, fur?.shells.furLength ?? 0, ground);
		this.#followBody();
		const reach = this.#crowd ? this.#crowd.reach * ROOM.crowd : model.radius * ROOM.body;
		this.#ground.fit(model.box, ground, reach);
	}

	/** Smooths the edges of eyes, noses and the like between hairs. */
	#smoothOutlines(object: Object3D, fur: Fur): void {
		if (!this.#smooth) return;
		for (const { material } of features(object, fur))
			if (material instanceof Material && !material.transparent) this.#edges.mark(material);
	}

	/**
	 * Moves the single body about its foot, with its shadow and the light's view of it.
	 *
	 * @param offset from its place, in radii of the body
	 * @param yaw turn about the upright axis, radians
	 */
	moveBody(offset: Vector3, yaw: number): void {
		const { model } = this;
		if (!model) return;
		this.#offset.copy(offset).multiplyScalar(model.radius);
		this.#yaw = yaw;
		stand(model, this.#offset, yaw);
		this.#followBody();
		this.setLight(this.toLamp);
	}

	/** Moves the soft shadow to where the body is above the ground. */
	#followBody(): void {
		const { model } = this;
		if (!model) return;
		this.#lift.copy(this.#offset);
		// A leap is one over the lowest point of the clip.
		if (model.clips) this.#lift.y += this.#pose.min.y - model.clips.faded(({ box }) => box.min.y);
		this.#shadow.follow(this.#lift, this.#yaw, heightOf(model), model.box);
	}

	/** Radius around which the lamp goes. */
	get lampRadius(): number {
		return this.#crowd?.lampRadius ?? this.radius;
	}

	/** Direction to the lamp, world axes, unit; it stays while the lamp's target moves. */
	get toLamp(): Vector3 {
		return this.#toLamp.subVectors(this.key.position, this.key.target.position).normalize();
	}

	/** @param environment replaces sky, lamp colour and backdrop; undefined: the page's own */
	setEnvironment(environment: Environment | undefined): void {
		this.#environment?.background.dispose();
		this.#environment = environment;
		this.sky.visible = !environment;
		this.key.color.copy(environment?.key.colour ?? KEY_COLOUR);
		this.scene.background = environment?.background ?? this.#backdrop;
		this.#ground.material.color.copy(environment?.ground ?? SLATE);
		this.#environmentLights.clear();
		if (environment) this.#environmentLights.add(environment.probe);
		for (const { direction, color } of environment?.others ?? []) {
			const lamp = new DirectionalLight(color);
			lamp.position.copy(direction);
			this.#environmentLights.add(lamp);
		}
		this.setLight(this.toLamp);
	}

	/** @param direction unit vector from the model to the lamp, world axes */
	setLight(direction: Vector3): void {
		const target = this.key.target.position.copy(this.centre).add(this.#offset);
		this.key.position.copy(target).addScaledVector(direction, 4 * this.radius);
		this.#lamps.turn(direction);
	}

	/** Number of lamps, 1 to 8, the dragged one included. */
	set lamps(count: number) {
		this.#lamps.lit = count;
		this.key.intensity = this.#lamps.share;
	}

	/** Factor of the picture's light, before tone mapping. */
	set exposure(factor: number) {
		this.renderer.toneMappingExposure = factor;
	}

	get gl(): WebGL2RenderingContext {
		return this.renderer.getContext() as WebGL2RenderingContext;
	}

	get limits(): FurLimits {
		return furLimits(this.gl);
	}

	/** @param width of the window in CSS pixels */
	resize(width: number, height: number): void {
		this.#width = width;
		this.#height = height;
		this.#setSize();
	}

	/** Drawn share of the resolution, per side. */
	get scale(): number {
		return this.#scale;
	}

	set scale(scale: number) {
		if (scale === this.#scale) return;
		this.#scale = scale;
		this.#setSize();
	}

	#setSize(): void {
		const ratio = Math.min(devicePixelRatio, MAX_PIXEL_RATIO) * this.#scale;
		// At least one pixel of the narrowest window.
		this.renderer.setPixelRatio(Math.max(ratio, 1 / Math.min(this.#width, this.#height)));
		this.renderer.setSize(this.#width, this.#height, false);
		if (this.#crowd) this.#crowd.pictureHeight = this.renderer.domElement.height;
	}

	/** Call while the context is lost: three would ask the next one to delete objects of this one. */
	loseContext(): void {
		disposeAll(this.scene);
		this.key.shadow.dispose();
		// A change of size frees the targets of the output.
		this.renderer.setSize(1, 1, false);
		this.#setSize();
	}

	render(camera: PerspectiveCamera): void {
		if (this.gl.isContextLost()) return;
		this.renderer.info.reset();
		this.renderer.render(this.scene, camera);
	}
}
