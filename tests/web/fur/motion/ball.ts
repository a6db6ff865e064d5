/** A ball of fur that is shaken and stroked. */

import { type BufferGeometry, Euler, Float32BufferAttribute, SphereGeometry, Vector3 } from 'three';
import { type Body, bodyOf, swingOf } from '../furs.ts';

const RADIUS = 1;

/** A ball with fur of a tenth of its radius, combed down and longer on one side. */
export function ball(): Body {
	const geometry: BufferGeometry = new SphereGeometry(RADIUS, 16, 10);
	const { count } = geometry.getAttribute('position');
	const normal = geometry.getAttribute('normal');
	const point = new Vector3();
	const rows = Array.from({ length: count }, (_, i) => {
		point.fromBufferAttribute(normal, i);
		const comb = new Vector3(0, -0.3, 0).addScaledVector(point, 0.3 * point.y);
		return { comb: comb.toArray(), fur: [1, 0.75 + 0.25 * point.x, 1, 0] };
	});
	geometry.setAttribute(
		'_comb',
		new Float32BufferAttribute(
			rows.flatMap(({ comb }) => comb),
			3,
		),
	);
	geometry.setAttribute(
		'_fur',
		new Float32BufferAttribute(
			rows.flatMap(({ fur }) => fur),
			4,
		),
	);
	return bodyOf(geometry, RADIUS / 10);
}

const lengths = (swing: Float32Array) =>
	Array.from({ length: swing.length / 3 }, (_, i) => Math.hypot(...swing.subarray(3 * i, 3 * i + 3)));
export const largest = (swing: Float32Array) => Math.max(...lengths(swing));

/** Farthest that a tip lies from its root along the skin. */
export function reach(body: Body): number {
	const { comb } = body.fur.follicles;
	return largest(swingOf(body).map((x, i) => x + (comb[i] as number)));
}

/** Largest distance of two tips of one hair, share of its length. */
export const apart = (a: Float32Array, b: Float32Array) => largest(a.map((x, i) => x - (b[i] as number)));

/** Where a shaken body is. */
export function shake({ place }: Body, t: number): void {
	place.position.set(0.2 * Math.sin(7 * t), 0.1 * Math.sin(11 * t + 1), 0.15 * t);
	place.rotation.copy(new Euler(0.4 * Math.sin(5 * t), 1.3 * t, 0.3 * Math.sin(3 * t)));
	place.updateMatrix();
}

/** A finger over the ball's front, from left to right in 0.4 s. */
export const finger = (t: number) => {
	const angle = -0.8 + 4 * Math.min(Math.max(t - 0.3, 0), 0.4);
	return new Vector3(RADIUS * Math.sin(angle), 0.1, RADIUS * Math.cos(angle));
};
