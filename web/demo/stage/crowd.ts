/** Crowd: many bodies of the model on a meadow. */

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
import { type Fur, FurInstances } from '../../fur/index.ts';
import { ContactShadow } from '../../page/backdrop.ts';
import { random } from '../../page/random.ts';
import { MAX_CROWD } from '../state/view.ts';
import type { Model } from './model.ts';

/** Place of a body in units of the room that it takes up, turn in radians, scale. */
export interface Spot {
	x: number;
	z: number;
	yaw: number;
	size: number;
}

const CANDIDATES = 24;
/** Radius of the ground that `count` bodies stand on, in the same units. */
export const spread = (count: number) => 0.85 * Math.sqrt(count);

/**
 * Scatters bodies without rows or clumps, by best candidates (Mitchell 1991): each takes the random spot that is farthest
 * from all before it. The first stands in the middle; more bodies never move earlier ones.
 */
export function scatter(count: number, seed = 7): Spot[] {
	const next = random(seed);
	const spots: Spot[] = [{ x: 0, z: 0, yaw: 0, size: 1 }];
	while (spots.length < count) {
		const reach = spread(spots.length + 1);
		let best = { x: 0, z: 0, away: -1 };
		for (let c = 0; c < CANDIDATES; c++) {
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
	// Drawn before the shadows, which lie on it.
	ground.renderOrder = -2;
	return ground;
}

export class Crowd extends Group {
	/** Radius of the sphere that the camera frames: the middle of the crowd, without its rim. */
	radius = 0;
	/** Radius of the sphere that holds the whole crowd. */
	reach = 0;
	readonly #instances: FurInstances;
	readonly #shadow = new ContactShadow();
	readonly #shadows: InstancedMesh;
	readonly #ground = lawn();
	/** Width of the ground that a body takes up. */
	readonly #room: number;

	/** @param fur on the model's body; it has to outlive the crowd */
	constructor(
		model: Model,
		readonly fur: Fur,
	) {
		super();
		const { box } = model;
		const { x: width, y: height, z: depth } = box.getSize(new Vector3());
		this.#room = Math.hypot(width, depth) + 2 * fur.asset.length;
		const foot = box.getCenter(new Vector3()).setY(box.min.y);

		this.#instances = new FurInstances(fur, MAX_CROWD);
		this.#shadow.fit(box, fur.asset.length);
		this.#shadow.updateMatrix();
		this.#shadows = new InstancedMesh(this.#shadow.geometry, this.#shadow.material, MAX_CROWD);
		this.#shadows.renderOrder = this.#shadow.renderOrder;
		this.#shadows.frustumCulled = false;
		const matrix = new Matrix4();
		for (const [i, { x, z, yaw, size }] of scatter(MAX_CROWD).entries()) {
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

	/** Height of the picture in pixels, for the levels of detail in the first frame. */
	set pictureHeight(pixels: number) {
		this.#instances.height = pixels;
	}

	/** Number of bodies shown, around the model's own place. */
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
