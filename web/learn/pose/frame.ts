/** Frame of a vertex on a joint, and the six moments of a lamp in it. */

import { type Direction, lightMoments } from '../../fur/reference.ts';

/** x to the right, y up, z towards the reader. */
export type Vector = readonly [number, number, number];

/** Axes of a vertex, unit vectors: T and B along the skin, N out of it. */
export interface Frame {
	tangent: Vector;
	bitangent: Vector;
	normal: Vector;
}

/** Frame of the upper side of a limb that lies to the right, turned with its joint. @param angle about z, radians */
export function frameAt(angle: number): Frame {
	const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
	// B = N × T
	return { tangent: [cos, sin, 0], bitangent: [0, 0, -1], normal: [-sin, cos, 0] };
}

const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Direction in a frame: lᵤ, lᵥ and the share along N. */
export function inFrame({ tangent, bitangent, normal }: Frame, light: Vector): Direction {
	return [dot(light, tangent), dot(light, bitangent), dot(light, normal)];
}

/** Moments lᵤ², lᵥ², lᵤlᵥ, lᵤ, lᵥ, 1 of a lamp of strength 1 at the tips; from below the skin less of it arrives. */
export function momentsIn(frame: Frame, light: Vector): number[] {
	return lightMoments({ kind: 'ptm' }, inFrame(frame, light), 1);
}

/** L: six numbers times six moments, not below 0. */
export function lightOf(coefficients: readonly number[], moments: readonly number[]): number {
	return Math.max(
		coefficients.reduce((sum, a, i) => sum + a * (moments[i] ?? 0), 0),
		0,
	);
}
