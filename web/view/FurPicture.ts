/** What one view shows: a furry model on its ground, its lights, lamp and camera. */

import {
	Box3,
	type DataTexture,
	DirectionalLight,
	Group,
	Mesh,
	MeshStandardMaterial,
	Scene,
	Sphere,
	Vector3,
} from 'three';
import { type Fur, fitFurShadow } from '../fur/index.ts';
import { daylightSky, KEY_COLOUR } from '../page/daylight.ts';
import { ContactShadow, Ground, SLATE } from '../page/ground.ts';
import { Lamp, lampDistance } from '../page/lamp/lamp.ts';
import { LampLines } from '../page/lamp/lines.ts';
import { MovingLight } from '../page/light.ts';
import { DEFAULT_LOOK, GLOW } from '../page/look.ts';
import type { Environment } from '../scene/environment.ts';
import { footing } from '../scene/footing.ts';
import type { Model } from '../scene/model.ts';
import { OrbitCamera } from './OrbitCamera.ts';

/** Radius of the ground, in radii of the body. */
const ROOM = 6;

/** A model on show. */
export interface Shown {
	model: Model;
	/** Fur that the model wears: its own, or that of a preset; undefined for none. */
	fur: Fur | undefined;
	/** Strength of its highlights; the usual one by default. */
	gloss?: number | undefined;
	dispose(): void;
}

export class FurPicture {
	readonly scene = new Scene();
	readonly camera = new OrbitCamera();
	readonly light: MovingLight;
	readonly lamp = new Lamp();
	/** Centre and radius of the body. */
	readonly centre = new Vector3();
	radius = 1;
	readonly #key = new DirectionalLight(KEY_COLOUR);
	readonly #sky = daylightSky();
	readonly #shadow = new ContactShadow();
	readonly #ground = new Ground();
	readonly #placeLights = new Group();
	readonly #pose = new Box3();
	readonly #lift = new Vector3();
	readonly #backdrop: DataTexture;
	#place: Environment | undefined;
	#shown: Shown | undefined;
	#aspect = 1;

	/** @param backdrop shared by all views; @param glides whether the light eases to its target */
	constructor(backdrop: DataTexture, glides: boolean) {
		this.#backdrop = backdrop;
		this.light = new MovingLight(glides);
		this.lamp.visible = false;
		this.lamp.addLines(new LampLines());
		this.scene.background = backdrop;
		this.scene.add(this.#key, this.#key.target, this.#sky, this.#placeLights, this.#shadow, this.#ground, this.lamp);
		this.#setStanding(false);
	}

	/** Direction to the lamp that the place itself has, if any. */
	get sun(): [number, number, number] | undefined {
		return this.#place?.key.direction?.toArray();
	}

	get shown(): Shown | undefined {
		return this.#shown;
	}

	/** Radius of the sphere that the lamp is on. */
	get lampRadius(): number {
		return this.radius * lampDistance;
	}

	/** Shows a model instead of the one before, which is disposed of; undefined shows none. */
	show(shown: Shown | undefined): void {
		if (this.#shown) {
			this.scene.remove(this.#shown.model.object);
			this.#shown.dispose();
		}
		this.#shown = shown;
		this.#setStanding(shown !== undefined);
		if (!shown) return;
		const { model, fur, gloss } = shown;
		if (fur)
			Object.assign(fur.shells.material, {
				gloss: gloss ?? DEFAULT_LOOK.gloss,
				backlight: DEFAULT_LOOK.backlight,
				glow: GLOW * fur.extent,
			});
		else this.#bare(model);
		this.scene.add(model.object);
		this.#frame();
		this.#followPose();
	}

	/** Lights a model without fur as skin is: there is nothing that metal could mirror. */
	#bare({ object }: Model): void {
		object.traverse((mesh) => {
			if (!(mesh instanceof Mesh)) return;
			mesh.castShadow = mesh.receiveShadow = true;
			for (const material of [mesh.material].flat())
				if (material instanceof MeshStandardMaterial) material.metalness = 0;
		});
	}

	#setStanding(stands: boolean): void {
		this.#shadow.visible = this.#ground.visible = stands;
	}

	/** @param place replaces sky, lamp colour and backdrop; undefined: the page's own */
	setPlace(place: Environment | undefined): void {
		this.#place?.background.dispose();
		this.#place = place;
		this.#sky.visible = !place;
		this.#key.color.copy(place?.key.colour ?? KEY_COLOUR);
		this.scene.background = place?.background ?? this.#backdrop;
		this.#ground.material.color.copy(place?.ground ?? SLATE);
		this.#placeLights.clear();
		if (place) this.#placeLights.add(place.probe);
		for (const { direction, color } of place?.others ?? []) {
			const lamp = new DirectionalLight(color);
			lamp.position.copy(direction);
			this.#placeLights.add(lamp);
		}
	}

	/** Fits the picture to its canvas. @param aspect width over height */
	fit(aspect: number): void {
		if (aspect === this.#aspect) return;
		this.#aspect = aspect;
		this.#aim();
	}

	/** Moves light and clip on. @returns whether the picture changes */
	step(elapsed: number): boolean {
		let changed = this.light.step(elapsed);
		if (changed) this.#shine();
		const { model, fur } = this.#shown ?? {};
		if (model?.clips?.step(elapsed)) {
			this.#followPose();
			changed = true;
		}
		if (fur?.update(elapsed)) changed = true;
		return changed;
	}

	/** Puts the lamps where the light's direction is. */
	#shine(): void {
		const { direction } = this.light;
		this.#key.target.position.copy(this.centre);
		this.#key.position.copy(this.centre).addScaledVector(direction, 4 * this.radius);
		this.lamp.place(direction, this.centre, this.radius);
	}

	/** Puts the light there at once. */
	shineFrom(direction: [number, number, number]): void {
		this.light.put(direction, false);
		this.#shine();
	}

	/** Fits light and camera to the body. */
	#frame(): void {
		if (!this.#shown) return;
		const { model, fur } = this.#shown;
		this.radius = model.radius;
		model.box.getCenter(this.centre);
		this.#shine();
		const length = fur?.shells.furLength ?? 0.05 * this.radius;
		fitFurShadow(this.#key, new Sphere(this.centre, this.radius + length), length);
		this.#aim();
	}

	/** Fits the camera to body and fur. */
	#aim(): void {
		this.camera.frame(this.centre, this.radius, this.#shown?.fur?.asset.length ?? 0, this.#aspect);
	}

	/** Fits ground and shadow to the body's pose; one clip needs other room than another. */
	#followPose(): void {
		if (!this.#shown) return;
		const { model, fur } = this.#shown;
		const { clips, box } = model;
		if (model.radius !== this.radius || !box.getCenter(this.#lift).equals(this.centre)) this.#frame();
		const height = footing({ ...model, fur });
		if (clips) clips.poseBox(this.#pose);
		else this.#pose.copy(box);
		this.#shadow.fit(this.#pose, fur?.shells.furLength ?? 0, height);
		// A leap is one over the lowest point of the clip.
		const leap = clips ? this.#pose.min.y - clips.faded((reach) => reach.box.min.y) : 0;
		this.#shadow.follow(this.#lift.set(0, leap, 0), 0, Math.max(box.max.y - box.min.y, this.radius), box);
		this.#ground.fit(box, height, this.radius * ROOM);
	}

	/** Takes everything out of the scene that another owns, and frees the rest but GPU objects of the scene. */
	clear(): void {
		this.show(undefined);
		this.setPlace(undefined);
		this.scene.background = null;
	}
}
