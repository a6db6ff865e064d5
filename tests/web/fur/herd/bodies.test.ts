import { Frustum, Matrix4, PerspectiveCamera, Sphere, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { cullBodies, cutLevels, levelOf, measurePowers, sortFarFirst } from '../../../../web/fur/herd/bodies.ts';

/** Numbers in 0..1, always the same ones. */
function noise(): () => number {
	let state = 1;
	return () => {
		state = (state * 48271) % 2147483647;
		return state / 2147483647;
	};
}

/** Spheres of very different sizes that do not meet. */
function disjoint(count: number): Sphere[] {
	const next = noise();
	const spheres: Sphere[] = [];
	while (spheres.length < count) {
		const centre = new Vector3(next(), next(), next()).multiplyScalar(20).subScalar(10);
		const sphere = new Sphere(centre, 0.2 + 3 * next() ** 2);
		const room = sphere.distanceToPoint(new Vector3(0, 0, 30));
		if (room > 0 && !spheres.some((other) => other.intersectsSphere(sphere))) spheres.push(sphere);
	}
	return spheres;
}

const packed = (spheres: Sphere[]) =>
	Float32Array.from(spheres.flatMap(({ center, radius }) => [...center.toArray(), radius]));

function sorted(spheres: Sphere[], eye: [number, number, number, number]): Uint32Array {
	const powers = new Float64Array(spheres.length);
	const order = Uint32Array.from(spheres, (_, i) => i);
	measurePowers(packed(spheres), spheres.length, eye, powers);
	sortFarFirst(order, spheres.length, powers);
	return order;
}

/** Nearest point of a sphere on a ray, as a multiple of the unit direction; undefined where it is missed. */
function hit({ center, radius }: Sphere, origin: Vector3, direction: Vector3): number | undefined {
	const to = center.clone().sub(origin);
	const along = to.dot(direction);
	const reach = radius ** 2 - (to.lengthSq() - along ** 2);
	return reach > 0 ? along - Math.sqrt(reach) : undefined;
}

describe('the order of bodies', () => {
	const spheres = disjoint(120);

	it.each([
		['from a point', [0, 0, 30, 1]],
		['by parallel rays', [0.6, 0, 0.8, 0]],
	] as const)('never draws a body over one in front of it, %s', (_, eye) => {
		const place = new Uint32Array(spheres.length);
		for (const [rank, body] of sorted(spheres, [...eye]).entries()) place[body] = rank;
		const [x, y, z, w] = eye;
		let pairs = 0;
		for (const [i, target] of spheres.entries()) {
			const direction = w
				? target.center
						.clone()
						.sub(new Vector3(x, y, z))
						.normalize()
				: new Vector3(-x, -y, -z);
			const origin = w ? new Vector3(x, y, z) : target.center.clone().addScaledVector(direction, -100);
			const own = hit(target, origin, direction) as number;
			for (const [j, other] of spheres.entries()) {
				const at = j === i ? undefined : hit(other, origin, direction);
				if (at === undefined) continue;
				pairs++;
				expect((place[j] as number) > (place[i] as number), `${j} over ${i}`).toBe(at < own);
			}
		}
		expect(pairs).toBeGreaterThan(100);
	});

	it('is the same whatever it was before', () => {
		const powers = Float64Array.from(spheres, ({ center }) => center.x);
		const orders = [1, 7, 53].map((step) => {
			const order = Uint32Array.from(spheres, (_, i) => (i * step) % spheres.length);
			sortFarFirst(order, spheres.length, powers);
			return order;
		});
		expect(orders[1]).toEqual(orders[0]);
		expect(orders[2]).toEqual(orders[0]);
		const falling = Array.from(orders[0] as Uint32Array, (body) => powers[body] as number);
		expect(falling).toEqual([...falling].sort((a, b) => b - a));
	});
});

describe('culling', () => {
	it("keeps what three's frustum keeps", () => {
		const camera = new PerspectiveCamera(40, 1.5, 1, 22);
		camera.position.set(3, 2, 12);
		camera.lookAt(1, 0, 0);
		camera.updateMatrixWorld();
		const matrix = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
		const frustum = new Frustum().setFromProjectionMatrix(matrix);
		const spheres = disjoint(120);
		const seen = new Uint8Array(spheres.length).fill(7);
		cullBodies(packed(spheres), spheres.length, frustum.planes, seen);
		expect([...seen]).toEqual(spheres.map((sphere) => Number(frustum.intersectsSphere(sphere))));
		expect(new Set(seen)).toEqual(new Set([0, 1]));
	});
});

describe('levels', () => {
	it.each([
		[3, 3],
		[6, 3],
		[6.01, 2],
		[24, 1],
		[30, 0],
		[96, 0],
		[500, 0],
	])('of %f shells is level %i', (shells, level) => {
		expect(levelOf(shells, [96, 24, 12, 6])).toBe(level);
	});

	it('are drawn one after the other, and nobody gets a coarser one than is due', () => {
		const next = noise();
		const count = 200;
		const order = Uint32Array.from({ length: count }, (_, i) => (i * 77) % count);
		const seen = Uint8Array.from(order, () => Number(next() < 0.7));
		const levels = Uint8Array.from(order, (_, i) => Math.min(Math.floor(next() ** (1 + i / 20) * 5), 4));
		const drawn = new Uint32Array(count);
		const ends = new Uint32Array(5);
		cutLevels(order, count, seen, levels, drawn, ends);
		const total = ends[0] as number;
		expect([...drawn.slice(0, total)]).toEqual([...order].filter((body) => seen[body]));
		for (let level = 4; level >= 0; level--) {
			const first = level === 4 ? 0 : (ends[level + 1] as number);
			expect(ends[level]).toBeGreaterThanOrEqual(first);
			for (const body of drawn.slice(first, ends[level])) expect(levels[body]).toBeGreaterThanOrEqual(level);
		}
	});

	it('follow each other at the very body that needs the finer one', () => {
		const ends = new Uint32Array(3);
		const drawn = new Uint32Array(5);
		const order = Uint32Array.of(4, 3, 2, 1, 0);
		cutLevels(order, 5, new Uint8Array(5).fill(1), Uint8Array.of(1, 0, 2, 1, 2), drawn, ends);
		// Farthest first: levels 2, 1, 2 (drawn as 1), 0, 1 (drawn as 0).
		expect([...ends]).toEqual([5, 3, 1]);
		cutLevels(order, 5, new Uint8Array(5), new Uint8Array(5), drawn, ends);
		expect([...ends]).toEqual([0, 0, 0]);
	});
});
