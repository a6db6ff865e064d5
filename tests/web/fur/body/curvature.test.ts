import { BufferAttribute, type BufferGeometry, CylinderGeometry, SphereGeometry, TorusGeometry, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { BodyCurvature } from '../../../../web/fur/body/BodyCurvature.ts';

/** Gives every vertex this tangent, in the tangent plane, and normals in bytes as files have them. */
function withTangents(geometry: BufferGeometry, tangent: (point: Vector3) => Vector3): BufferGeometry {
	const { count } = geometry.getAttribute('position');
	const normal = geometry.getAttribute('normal');
	const bytes = Int8Array.from(normal.array as Float32Array, (value) => Math.round(127 * value));
	geometry.setAttribute('normal', new BufferAttribute(bytes, 3, true));
	const values = new Float32Array(4 * count);
	const [point, n] = [new Vector3(), new Vector3()];
	for (let i = 0; i < count; i++) {
		n.fromBufferAttribute(normal, i).normalize();
		const t = tangent(point.fromBufferAttribute(geometry.getAttribute('position'), i));
		values.set([...t.addScaledVector(n, -n.dot(t)).normalize(), 1], 4 * i);
	}
	geometry.setAttribute('tangent', new BufferAttribute(values, 4));
	return geometry;
}

/** Largest errors of the three numbers, as shares of `scale`. */
function errors(
	geometry: BufferGeometry,
	wanted: (point: Vector3) => number[],
	scale: number,
	skip?: (p: Vector3) => boolean,
) {
	BodyCurvature.of(geometry).mark(geometry);
	const [position, curvature] = [geometry.getAttribute('position'), geometry.getAttribute('curvature')];
	const point = new Vector3();
	const worst = [0, 0, 0];
	for (let i = 0; i < position.count; i++) {
		point.fromBufferAttribute(position, i);
		if (skip?.(point)) continue;
		const expected = wanted(point);
		for (const c of worst.keys())
			worst[c] = Math.max(worst[c] ?? 0, Math.abs(curvature.getComponent(i, c) - (expected[c] ?? 0)) / scale);
	}
	return worst;
}

describe('BodyCurvature', () => {
	it('is that of a ball, in every direction', () => {
		const ball = withTangents(new SphereGeometry(2, 64, 32), (p) => new Vector3(-p.z, 0.3, p.x));
		const worst = errors(
			ball,
			() => [0.5, 0.5, 0],
			0.5,
			({ y }) => Math.abs(y) > 1.95,
		);
		for (const error of worst) expect(error).toBeLessThan(0.08);
	});

	it('is that of a cylinder: none along it', () => {
		const along = withTangents(new CylinderGeometry(0.5, 0.5, 4, 48, 32, true), () => new Vector3(0, 1, 0));
		const inside = ({ y }: Vector3) => Math.abs(y) > 1.7;
		for (const error of errors(along, () => [0, 2, 0], 2, inside)) expect(error).toBeLessThan(0.05);
		const askew = withTangents(new CylinderGeometry(0.5, 0.5, 4, 48, 32, true), (p) => new Vector3(-p.z, 0.5, p.x));
		for (const error of errors(askew, () => [1, 1, 1], 2, inside)) expect(error).toBeLessThan(0.05);
	});

	it('is that of a torus, negative at its hole', () => {
		const [ring, tube] = [1, 0.4];
		const torus = withTangents(new TorusGeometry(ring, tube, 32, 80), ({ x, y }) => new Vector3(-y, x, 0));
		const wanted = ({ x, y }: Vector3) => {
			const away = Math.hypot(x, y);
			return [(away - ring) / tube / away, 1 / tube, 0];
		};
		for (const error of errors(torus, wanted, 1 / tube)) expect(error).toBeLessThan(0.08);
	});
});
