/** Crowd: many bodies of the model. */

import { Group, InstancedMesh, Matrix4, Vector3 } from 'three';
import { type Fur, FurInstances } from '../../fur/index.ts';
import { ContactShadow } from '../../page/ground.ts';
import { random } from '../../page/random.ts';
import type { ClipPlayer } from '../../scene/clips/ClipPlayer.ts';
import { footing } from '../../scene/footing.ts';
import type { Model } from '../../scene/model.ts';
import { MAX_CROWD } from '../state/view.ts';

/** Place of a body in units of the room that it takes up, turn in radians, scale. */
export interface Spot {
	x: number;
	z: number;
	yaw: number;
	size: number;
}

/** Radius around which the lamp goes, in radii of what the camera frames. */
const LAMP = 0.6;
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

export class Crowd extends Group {
	/** Radius of the sphere that the camera frames: the middle of the crowd, without its rim. */
	radius = 0;
	/** Radius of the sphere that holds the whole crowd. */
	reach = 0;
	readonly #instances: FurInstances;
	readonly #shadow = new ContactShadow();
	readonly #shadows: InstancedMesh;
	/** Width of the ground that a body takes up. */
	readonly #room: number;

	/** @param fur on the model's body; it has to outlive the crowd */
	constructor(
		model: Model,
		readonly fur: Fur,
	) {
		super();
		const { box } = model;
		const { x: width, z: depth } = box.getSize(new Vector3());
		this.#room = Math.hypot(width, depth) + 2 * fur.asset.length;
		const foot = box.getCenter(new Vector3()).setY(box.min.y);

		this.#instances = new FurInstances(fur, MAX_CROWD);
		this.#shadow.fit(box, fur.asset.length, footing({ ...model, fur }));
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
			this.#instances.setPoseAt(i, i % FurInstances.maxPoses);
			this.#shadows.setMatrixAt(i, matrix.multiply(this.#shadow.matrix));
		}
		this.add(this.#shadows, this.#instances);
		// Without the code all faces are drawn.
		this.#simplify().catch(() => {});
	}

	/** Draws far bodies on fewer faces, once the code that leaves them out is there. */
	async #simplify(): Promise<void> {
		const { MeshoptSimplifier } = await import('meshoptimizer/simplifier');
		await MeshoptSimplifier.ready;
		this.#instances.simplify(MeshoptSimplifier);
	}

	/** Height of the picture in pixels, for the levels of detail in the first frame. */
	set pictureHeight(pixels: number) {
		this.#instances.height = pixels;
	}

	/** Brings the bodies to the clip, in step with the first or a part of the loop ahead. */
	pose(clips: ClipPlayer): void {
		clips.eachPhase(FurInstances.maxPoses, (phase) => this.#instances.capturePose(phase));
	}

	/** Radius around which the lamp goes: around all that is framed it would leave the first picture. */
	get lampRadius(): number {
		return LAMP * this.radius;
	}

	/** Number of bodies shown, around the model's own place. */
	override set count(value: number) {
		this.#instances.count = this.#shadows.count = value;
		this.reach = (spread(value) + 1) * this.#room;
		this.radius = 0.5 * this.reach;
	}

	override dispose(): void {
		this.removeFromParent();
		this.#instances.dispose();
		this.#shadows.dispose();
		const { geometry, material } = this.#shadow;
		geometry.dispose();
		material.dispose();
		material.map?.dispose();
	}
}
