/** How a body stands that is moved about: on its foot, and leaning as far as it is drawn aside. */

import { Object3D, Quaternion, Vector3 } from 'three';
import type { Model } from './models.ts';

/** Radians that a body leans where its foot is drawn aside by its height. */
const leaning = 0.9;

type Body = Pick<Model, 'object' | 'box' | 'radius'>;

const foot = new Vector3();
const axis = new Vector3();
const lean = new Quaternion();

/** Of a flat body its radius: what lies does not topple. */
export function heightOf({ box, radius }: Pick<Body, 'box' | 'radius'>): number {
	return Math.max(box.max.y - box.min.y, radius);
}

/**
 * Moves a body from where its file has it.
 *
 * @param offset of its foot, world units
 * @param yaw turn about the upright axis, radians
 */
export function stand(body: Body, offset: Vector3, yaw: number): void {
	const { object, box } = body;
	box.getCenter(foot).setY(box.min.y);
	const aside = Math.hypot(offset.x, offset.z);
	axis.set(offset.z, 0, -offset.x).divideScalar(aside || 1);
	lean.setFromAxisAngle(axis, (leaning * aside) / heightOf(body));
	object.quaternion.setFromAxisAngle(Object3D.DEFAULT_UP, yaw).premultiply(lean);
	object.position.copy(foot).negate().applyQuaternion(object.quaternion).add(foot).add(offset);
	object.updateMatrixWorld();
}
