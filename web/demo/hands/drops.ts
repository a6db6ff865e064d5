/** Shower under the rain brush: drops that fall and burst. Only for the eye: the fur gets wet without them. */

import {
	type Camera,
	DataTexture,
	InstancedMesh,
	LinearFilter,
	Matrix4,
	MeshBasicMaterial,
	PlaneGeometry,
	Vector3,
} from 'three';
import { random } from '../../page/random.ts';

const MAX_DROPS = 40;
/** Drops per second. */
const DROP_RATE = 70;
/** In radii of the body: height of the fall, its speed per second, width and length of a drop. */
const FALL_HEIGHT = 1.1;
const FALL_SPEED = 3.4;
const DROP_SIZE = [0.012, 0.11] as const;
/** Seconds from landing to the end of a burst. */
const BURST_TIME = 0.16;

/** Picture of a drop: pale, with soft edges. */
function streak(width = 8, length = 32): DataTexture {
	const texels = new Uint8Array(width * length * 4).fill(255);
	for (let y = 0; y < length; y++) {
		for (let x = 0; x < width; x++) {
			const [u, v] = [(2 * x + 1) / width - 1, (2 * y + 1) / length - 1];
			texels[4 * (y * width + x) + 3] = 255 * (1 - u * u) * (1 - v * v) ** 2;
		}
	}
	const texture = new DataTexture(texels, width, length);
	texture.magFilter = LinearFilter;
	texture.minFilter = LinearFilter;
	texture.needsUpdate = true;
	return texture;
}

const matrix = new Matrix4();
const scale = new Vector3();

export class Drops extends InstancedMesh<PlaneGeometry, MeshBasicMaterial> {
	/** Landing place of each drop, world; seconds since landing, negative while it falls. */
	readonly #places = new Float32Array(3 * MAX_DROPS);
	readonly #times = new Float64Array(MAX_DROPS);
	readonly #next = random(3);
	/** Drops due, less than one between frames. */
	#due = 0;
	/** Radius of the body. */
	#bodyRadius = 1;

	constructor() {
		const look = { transparent: true, depthWrite: false, opacity: 0.55, color: '#cfe2f2' };
		super(new PlaneGeometry(1, 1), new MeshBasicMaterial({ map: streak(), ...look }), MAX_DROPS);
		this.name = 'drops';
		// After the fur, whose depth hides what is behind it.
		this.renderOrder = 1;
		this.frustumCulled = this.visible = false;
		this.count = 0;
	}

	/** Adds drops for the given seconds. @param radius of the shower around a place on the skin, world; @param body radius of the body */
	pour(place: Vector3, normal: Vector3, radius: number, body: number, seconds: number): void {
		this.#due += DROP_RATE * seconds;
		for (; this.#due >= 1; this.#due--) {
			if (this.count >= MAX_DROPS) continue;
			const [away, angle] = [radius * Math.sqrt(this.#next()), 2 * Math.PI * this.#next()];
			const [x, z] = [away * Math.cos(angle), away * Math.sin(angle)];
			// On the plane of the skin there, unless that is steep.
			const y = -(normal.x * x + normal.z * z) / Math.max(normal.y, 0.35);
			const i = this.count++;
			this.#places.set([place.x + x, place.y + Math.min(Math.max(y, -radius), radius), place.z + z], 3 * i);
			this.#times[i] = -(FALL_HEIGHT / FALL_SPEED) * (0.7 + 0.3 * this.#next());
		}
		this.#bodyRadius = body;
	}

	/** @returns true while any of them is seen */
	step(seconds: number, camera: Camera): boolean {
		const places = this.#places;
		const times = this.#times;
		const unit = this.#bodyRadius;
		const { elements } = camera.matrixWorld;
		// Each faces the camera, turned about the upright axis.
		const yaw = Math.atan2(elements[8] as number, elements[10] as number);
		for (let i = 0; i < this.count; i++) {
			times[i] = (times[i] as number) + seconds;
			if ((times[i] as number) < BURST_TIME) continue;
			// The last drop takes the place of one that has ended.
			const last = --this.count;
			times[i] = times[last] as number;
			places.copyWithin(3 * i, 3 * last, 3 * last + 3);
			i--;
		}
		for (let i = 0; i < this.count; i++) {
			const time = times[i] as number;
			const spread = Math.max(time / BURST_TIME, 0);
			const above = Math.max(-time * FALL_SPEED, 0) * unit;
			matrix
				.makeRotationY(yaw)
				.scale(
					scale.set(
						DROP_SIZE[0] * (1 + 5 * spread) * unit,
						DROP_SIZE[1] * (spread > 0 ? 0.25 * (1 - spread) : 1) * unit,
						1,
					),
				);
			const y = (places[3 * i + 1] as number) + above + 0.5 * DROP_SIZE[1] * unit;
			matrix.setPosition(places[3 * i] as number, y, places[3 * i + 2] as number);
			this.setMatrixAt(i, matrix);
		}
		this.instanceMatrix.needsUpdate = this.count > 0;
		this.visible = this.count > 0;
		return this.visible;
	}
}
