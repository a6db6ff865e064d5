/** Visible lamp: a small glowing bulb on a sphere around the model, and its ray. */

import {
	AdditiveBlending,
	type BufferGeometry,
	type Camera,
	DataTexture,
	DoubleSide,
	Group,
	LinearFilter,
	type Material,
	MathUtils,
	Mesh,
	MeshBasicMaterial,
	PlaneGeometry,
	Sprite,
	SpriteMaterial,
	Vector3,
} from 'three';

/** Distance of the lamp from the model's centre, in radii of the model. */
export const lampDistance = 1.22;

export const warm = [1, 0.8, 0.55] as const;
const resting = 0.35; // strength of the lines while the light rests
const easing = 0.18; // seconds in which they brighten

/** Grey texture for additive light; `brightness` of u and v in -1..1 is in 0..1. */
function lightMap(width: number, height: number, brightness: (u: number, v: number) => number): DataTexture {
	const texels = new Uint8Array(width * height * 4).fill(255);
	for (let y = 0; y < height; y++) {
		for (let x = 0; x < width; x++) {
			const value = brightness((2 * x + 1) / width - 1, (2 * y + 1) / height - 1);
			texels.fill(255 * value, (y * width + x) * 4, (y * width + x) * 4 + 3);
		}
	}
	const texture = new DataTexture(texels, width, height);
	texture.magFilter = LinearFilter;
	texture.minFilter = LinearFilter;
	texture.needsUpdate = true;
	return texture;
}

/** Properties of a material that adds light. */
export const additive = { blending: AdditiveBlending, depthWrite: false, transparent: true };

/**
 * Built once for a lamp at distance 1; all motion is rotation or scale:
 *
 *     lamp ── carrier (azimuth) ── arm (elevation) ── ray, rail, bulb, halo
 *         └─ horizon
 */
export class Lamp extends Group {
	readonly #carrier = new Group();
	readonly #arm = new Group();
	readonly #ray: Mesh<PlaneGeometry, MeshBasicMaterial>;
	readonly #faint: Material[] = [];
	readonly #eye = new Vector3();
	#strength = 0;
	readonly #dim = (material: Material) => {
		material.opacity = this.#strength;
	};
	/** Whether the light is being moved: ray and rail are brighter then. */
	active = false;

	constructor() {
		super();
		// A soft band, since lines have steps without multisampling.
		this.#ray = new Mesh(
			new PlaneGeometry(1, 0.012).translate(0.5, 0, 0),
			new MeshBasicMaterial({
				map: lightMap(64, 16, (u, v) => (1 - v * v) ** 2 * ((u + 1) / 2) ** 1.2),
				side: DoubleSide,
				// Both sides at once: with two passes three looks the program up in every frame.
				forceSinglePass: true,
				...additive,
			}),
		);
		this.#ray.material.color.setRGB(...warm);
		this.#faint.push(this.#ray.material);

		// A disc with a soft rim: a ball has steps without multisampling.
		const disc = lightMap(64, 64, (u, v) => 1 - MathUtils.smoothstep(Math.hypot(u, v), 0.7, 1));
		const bulb = new Sprite(new SpriteMaterial({ map: disc, ...additive }));
		bulb.material.color.setRGB(4, 3.3, 2.5);
		bulb.scale.setScalar(0.048);
		const map = lightMap(64, 64, (u, v) => (1 - Math.min(Math.hypot(u, v), 1)) ** 3);
		const halo = new Sprite(new SpriteMaterial({ map, ...additive }));
		halo.material.color.setRGB(1.1, 0.72, 0.4);
		halo.scale.setScalar(0.26);
		for (const part of [bulb, halo]) part.position.x = 1;

		this.#arm.add(this.#ray, bulb, halo);
		this.#carrier.add(this.#arm);
		this.add(this.#carrier);
		this.#drawLast();
	}

	/** Adds the lines of `LampLines`. */
	addLines({ horizon, rail }: Record<'horizon' | 'rail', Mesh<BufferGeometry, Material>>): void {
		this.add(horizon);
		this.#arm.add(rail);
		this.#faint.push(horizon.material, rail.material);
		this.#faint.forEach(this.#dim);
		this.#drawLast();
	}

	/** After the fur, whose depth hides what is behind it. */
	#drawLast(): void {
		this.traverse((part) => {
			part.renderOrder = 1;
		});
	}

	/** @param direction unit vector from the model to the lamp, world axes; @param radius of the model */
	place(direction: Vector3, centre: Vector3, radius: number): void {
		this.position.copy(centre);
		this.scale.setScalar(radius * lampDistance);
		this.#carrier.rotation.y = Math.atan2(-direction.z, direction.x);
		this.#arm.rotation.z = Math.asin(Math.min(Math.max(direction.y, -1), 1));
	}

	/**
	 * Turns the ray's band to the camera.
	 *
	 * @param elapsed seconds since the last frame; Infinity to skip easing
	 * @returns whether brightness is still changing
	 */
	glide(camera: Camera, elapsed: number): boolean {
		this.#arm.updateWorldMatrix(true, false);
		const eye = this.#arm.worldToLocal(this.#eye.setFromMatrixPosition(camera.matrixWorld));
		this.#ray.rotation.x = Math.atan2(-eye.y, eye.z);
		const goal = this.active ? 1 : resting;
		if (this.#strength === goal) return false;
		this.#strength += (goal - this.#strength) * (1 - Math.exp(-elapsed / easing));
		if (Math.abs(goal - this.#strength) < 0.004) this.#strength = goal;
		this.#faint.forEach(this.#dim);
		return true;
	}
}
