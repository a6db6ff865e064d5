/** Many bodies of the model on show, on a meadow. */

import {
	Float32BufferAttribute,
	Group,
	InstancedMesh,
	MathUtils,
	Matrix4,
	Mesh,
	MeshStandardMaterial,
	RingGeometry,
	Vector3,
} from 'three';
import { type Fur, FurInstances } from '../fur/index.ts';
import { ContactShadow } from '../page/backdrop.ts';
import { random } from '../page/random.ts';
import type { Model } from './models.ts';

/** The largest crowd. */
export const maxCrowd = 400;

/** Where a body stands, in units of the space that it takes up; how it is turned, radians; how large it is. */
export interface Spot {
	x: number;
	z: number;
	yaw: number;
	size: number;
}

const candidates = 24;
/** Radius of the ground that `count` bodies stand on, in the same units. */
export const spread = (count: number) => 0.85 * Math.sqrt(count);

/**
 * Scatters bodies without rows or clumps: each takes that of some random spots which is farthest from all before it
 * (Mitchell 1991). The first stands in the middle as the model itself does; more bodies never move those before.
 */
export function scatter(count: number, seed = 7): Spot[] {
	const next = random(seed);
	const spots: Spot[] = [{ x: 0, z: 0, yaw: 0, size: 1 }];
	while (spots.length < count) {
		const reach = spread(spots.length + 1);
		let best = { x: 0, z: 0, away: -1 };
		for (let c = 0; c < candidates; c++) {
			const [radius, angle] = [reach * Math.sqrt(next()), 2 * Math.PI * next()];
			const [x, z] = [radius * Math.cos(angle), radius * Math.sin(angle)];
			const away = spots.reduce(
				(least, spot) => Math.min(least, Math.hypot(spot.x - x, spot.z - z)),
				Number.POSITIVE_INFINITY,
			);
			if (away > best.away) best = { x, z, away };
		}
		spots.push({ x: best.x, z: best.z, yaw: 2 * Math.PI * next(), size: 0.8 + 0.35 * next() });
	}
	return spots.slice(0, count);
}

/** A lawn of radius 1 that fades into the backdrop at its rim. */
function lawn(): Mesh<RingGeometry, MeshStandardMaterial> {
	const geometry = new RingGeometry(0, 1, 64, 12).rotateX(-Math.PI / 2);
	const position = geometry.getAttribute('position');
	const shades = Array.from({ length: position.count }, (_, i) => {
		const away = Math.hypot(position.getX(i), position.getZ(i));
		return [1, 1, 1, 1 - MathUtils.smoothstep(away, 0.35, 1)];
	});
	geometry.setAttribute('color', new Float32BufferAttribute(shades.flat(), 4));
	const material = new MeshStandardMaterial({ vertexColors: true, transparent: true, depthWrite: false, roughness: 1 });
	material.color.setRGB(0.075, 0.105, 0.045);
	const ground = new Mesh(geometry, material);
	ground.receiveShadow = true;
	// Before the shadows, which lie on it.
	ground.renderOrder = -2;
	return ground;
}

export class Crowd extends Group {
	/** Of the sphere that the camera frames: the middle of the crowd, and not all of its rim. */
	radius = 0;
	/** Of the sphere that holds all of it. */
	reach = 0;
	readonly #instances: FurInstances;
	readonly #shadow = new ContactShadow();
	readonly #shadows: InstancedMesh;
	readonly #ground = lawn();
	/** Width of the ground that a body takes up. */
	readonly #room: number;

	/** @param fur on the model's body, which has to outlive the crowd */
	constructor(
		model: Model,
		readonly fur: Fur,
	) {
		super();
		const { box } = model;
		const { x: width, y: height, z: depth } = box.getSize(new Vector3());
		this.#room = Math.hypot(width, depth) + 2 * fur.asset.length;
		const foot = box.getCenter(new Vector3()).setY(box.min.y);

		this.#instances = new FurInstances(fur, maxCrowd);
		this.#shadow.fit(box, fur.asset.length);
		this.#shadow.updateMatrix();
		this.#shadows = new InstancedMesh(this.#shadow.geometry, this.#shadow.material, maxCrowd);
		this.#shadows.renderOrder = this.#shadow.renderOrder;
		this.#shadows.frustumCulled = false;
		const matrix = new Matrix4();
		for (const [i, { x, z, yaw, size }] of scatter(maxCrowd).entries()) {
			// Turned and sized about its foot, then moved.
			matrix.makeRotationY(yaw).scale(new Vector3(size, size, size));
			const place = foot.clone().applyMatrix4(matrix).negate().add(foot);
			matrix.setPosition(place.add(new Vector3(x, 0, z).multiplyScalar(this.#room)));
			this.#instances.setMatrixAt(i, matrix);
			this.#shadows.setMatrixAt(i, matrix.multiply(this.#shadow.matrix));
		}
		this.#ground.position.copy(foot).setY(this.#shadow.position.y - 0.001 * height);
		this.add(this.#ground, this.#shadows, this.#instances);
	}

	/** Pixels of the picture's height, by which the first frame knows how much of each body it wants. */
	set pictureHeight(pixels: number) {
		this.#instances.height = pixels;
	}

	/** The first bodies alone, the model's own place in their middle. */
	override set count(value: number) {
		this.#instances.count = this.#shadows.count = value;
		this.reach = (spread(value) + 1) * this.#room;
		this.radius = 0.5 * this.reach;
		this.#ground.scale.setScalar(2.2 * this.reach);
	}

	override dispose(): void {
		this.removeFromParent();
		this.#instances.dispose();
		this.#shadows.dispose();
		for (const { geometry, material } of [this.#shadow, this.#ground]) {
			geometry.dispose();
			material.dispose();
		}
		this.#shadow.material.map?.dispose();
	}
}
