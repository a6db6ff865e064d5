/** Bounding sphere of a body in its pose. */

import { type BufferGeometry, Matrix4, type Skeleton, Sphere, Vector3 } from 'three';

/** Surface of a body, with the matrix that takes its units to those of the bounds. */
export interface BoundedSurface {
	geometry: BufferGeometry;
	matrix: Matrix4;
	/** Length of a target's change of a vertex. */
	reach?: ((vertex: number, target: number) => number) | undefined;
}

/** Vertices that a joint moves, at rest. */
interface Ball {
	joint: number;
	sphere: Sphere;
	/** Largest change by each morph target. */
	reach: Float64Array;
}

const matrix = new Matrix4();
const own = new Matrix4();
const moved = new Sphere();
const low = new Vector3();
const high = new Vector3();
const place = new Vector3();

/**
 * Bounds of all poses of a body: a sphere per joint around the vertices that it moves. A vertex moved by several joints lies
 * between the places to which each would take it, so a sphere around all of theirs holds it.
 */
export class PosedBounds {
	readonly #balls: Ball[] = [];
	/** Spheres in the pose: center, radius. */
	readonly #posed: Float64Array;

	/** @param targets number of morph targets */
	constructor(surfaces: readonly BoundedSurface[], targets: number) {
		const boxes = new Map<number, { low: Vector3; high: Vector3 }>();
		visit(surfaces, (joint, point) => {
			const box = boxes.get(joint) ?? { low: point.clone(), high: point.clone() };
			box.low.min(point);
			box.high.max(point);
			boxes.set(joint, box);
		});
		const balls = new Map<number, Ball>();
		for (const [joint, box] of boxes) {
			const sphere = new Sphere(box.low.add(box.high).multiplyScalar(0.5), 0);
			const ball = { joint, sphere, reach: new Float64Array(targets) };
			balls.set(joint, ball);
			this.#balls.push(ball);
		}
		visit(surfaces, (joint, point, { matrix, reach }, vertex) => {
			const { sphere, reach: all } = balls.get(joint) as Ball;
			sphere.radius = Math.max(sphere.radius, sphere.center.distanceTo(point));
			if (!reach) return;
			const scale = matrix.getMaxScaleOnAxis();
			for (let target = 0; target < targets; target++)
				all[target] = Math.max(all[target] as number, scale * reach(vertex, target));
		});
		this.#posed = new Float64Array(4 * this.#balls.length);
	}

	/**
	 * @param skeleton undefined: none, only targets
	 * @param place of the units in the world; what `skeleton` needs instead is its bind matrix
	 * @param influences of the morph targets
	 * @param target takes the sphere, world
	 * @returns largest world length of a unit
	 */
	measure(skeleton: Skeleton | undefined, placement: Matrix4, influences: readonly number[], target: Sphere): number {
		low.setScalar(Number.POSITIVE_INFINITY);
		high.setScalar(Number.NEGATIVE_INFINITY);
		let unit = 0;
		for (const [i, { joint, sphere, reach }] of this.#balls.entries()) {
			matrix.copy(placement);
			const bone = skeleton?.bones[joint];
			const inverse = skeleton?.boneInverses[joint];
			if (bone && inverse) matrix.premultiply(own.multiplyMatrices(bone.matrixWorld, inverse));
			moved.copy(sphere);
			for (let t = 0; t < reach.length; t++) moved.radius += Math.abs(influences[t] ?? 0) * (reach[t] as number);
			moved.applyMatrix4(matrix);
			unit = Math.max(unit, matrix.getMaxScaleOnAxis());
			moved.center.toArray(this.#posed, 4 * i);
			this.#posed[4 * i + 3] = moved.radius;
			low.min(place.copy(moved.center).subScalar(moved.radius));
			high.max(place.copy(moved.center).addScalar(moved.radius));
		}
		if (this.#balls.length === 0) {
			target.makeEmpty();
			return 1;
		}
		target.center.addVectors(low, high).multiplyScalar(0.5);
		target.radius = 0;
		for (let i = 0; i < this.#balls.length; i++) {
			const away = target.center.distanceTo(place.fromArray(this.#posed, 4 * i));
			target.radius = Math.max(target.radius, away + (this.#posed[4 * i + 3] as number));
		}
		return unit;
	}
}

/** Visits every vertex of all surfaces once for each joint that moves it; of a surface without joints once, as joint 0. */
function visit(
	surfaces: readonly BoundedSurface[],
	call: (joint: number, point: Vector3, surface: BoundedSurface, vertex: number) => void,
): void {
	const point = new Vector3();
	for (const surface of surfaces) {
		const { geometry, matrix } = surface;
		const position = geometry.getAttribute('position');
		const joints = geometry.getAttribute('skinIndex');
		const weights = geometry.getAttribute('skinWeight');
		for (let i = 0; i < position.count; i++) {
			point.fromBufferAttribute(position, i).applyMatrix4(matrix);
			if (!joints || !weights) call(0, point, surface, i);
			else
				for (let c = 0; c < 4; c++)
					if (weights.getComponent(i, c) > 0) call(joints.getComponent(i, c), point, surface, i);
		}
	}
}
