/** Pose of a moved body: on its foot, and leaning with its offset. */

import { Object3D, Quaternion, Vector3 } from 'three';
import type { Model } from '../../scene/model.ts';

/** Lean in radians at an offset of the body's height. */
const LEAN = 0.9;

type Body = Pick<Model, 'object' | 'box' | 'radius'>;

const foot = new Vector3();
const axis = new Vector3();
const lean = new Quaternion();

/** Height of a body, at least its radius: flat bodies do not topple. */
export function heightOf({ box, radius }: Pick<Body, 'box' | 'radius'>): number {
	return Math.max(box.max.y - box.min.y, radius);
}

/**
 * Poses a body, from its place in the file.
 *
 * @param offset of its foot, world units
 * @param yaw turn about the upright axis, radians
 */
export function stand(body: Body, offset: Vector3, yaw: number): void {
	const { object, box } = body;
	box.getCenter(foot).setY(box.min.y);
	const aside = Math.hypot(offset.x, offset.z);
	axis.set(offset.z, 0, -offset.x).divideScalar(aside || 1);
	lean.setFromAxisAngle(axis, (LEAN * aside) / heightOf(body));
	object.quaternion.setFromAxisAngle(Object3D.DEFAULT_UP, yaw).premultiply(lean);
	object.position.copy(foot).negate().applyQuaternion(object.quaternion).add(foot).add(offset);
	object.updateMatrixWorld();
}
