import { MeshoptSimplifier } from 'meshoptimizer';
import { BufferAttribute, BufferGeometry, Mesh, Raycaster, Vector3 } from 'three';
import { expect, it } from 'vitest';
import type { Fur } from '../../../../web/fur/Fur.ts';
import { EdgeFaces } from '../../../../web/fur/fins/EdgeFaces.ts';
import { FarSurface } from '../../../../web/fur/herd/FarSurface.ts';
import { farFins } from '../../../../web/fur/herd/farFins.ts';

const SIDE = 20;
/** Columns at which one patch ends and the other begins. */
const [BEGIN, END] = [8, 12];

/**
 * A hill of SIDE × SIDE squares in two patches that overlap by a few columns, where their weights sum to 1.
 *
 * @param furs the second patch is of a second fur
 */
function hill(furs = 1): BufferGeometry {
	const rows: Record<string, number[]> = {
		position: [],
		normal: [],
		tangent: [],
		uv: [],
		_fur: [],
		_comb: [],
		_region: [],
	};
	const index: number[] = [];
	for (const [patch, [from, to]] of [
		[0, END],
		[BEGIN, SIDE],
	].entries() as ArrayIterator<[number, [number, number]]>) {
		const first = (rows.uv as number[]).length / 2;
		for (let y = 0; y <= SIDE; y++)
			for (let x = from; x <= to; x++) {
				const [u, v] = [x / SIDE - 0.5, y / SIDE - 0.5];
				const second = Math.min(Math.max((x - BEGIN) / (END - BEGIN), 0), 1);
				const normal = new Vector3(u, v, 1).normalize();
				rows.position?.push(u, v, -0.5 * (u * u + v * v));
				rows.normal?.push(...normal.toArray());
				rows.tangent?.push(...new Vector3(1, 0, -u).normalize().toArray(), 1);
				rows.uv?.push(4 * u + 0.3 * patch, 4 * v);
				rows._fur?.push(furs > 1 ? 1 : patch ? second : 1 - second, 0.75, 1, 0.25);
				rows._comb?.push(0, 0.2);
				rows._region?.push(0, 1, patch / 255);
				if (x === to || y === SIDE) continue;
				const [at, wide] = [first + y * (to - from + 1) + x - from, to - from + 1];
				index.push(at, at + 1, at + wide + 1, at, at + wide + 1, at + wide);
			}
	}
	const geometry = new BufferGeometry().setIndex(index);
	const count = (rows.uv as number[]).length / 2;
	for (const [name, values] of Object.entries(rows))
		if (name !== '_region' || furs > 1)
			geometry.setAttribute(name, new BufferAttribute(Float32Array.from(values), values.length / count));
	return geometry;
}

const facesIn = ({ index }: BufferGeometry) => (index?.count ?? 0) / 3;
const furIn = ({ attributes }: BufferGeometry) => attributes._fur as BufferAttribute;

it('has each face of overlapping patches once, in the patch of the larger weight', () => {
	const surface = hill();
	const far = new FarSurface(surface).geometry();
	expect(facesIn(surface)).toBe(2 * SIDE * (SIDE + END - BEGIN));
	expect(facesIn(far)).toBe(2 * SIDE * SIDE);
	const area = new Set<string>();
	for (const vertex of (far.index as BufferAttribute).array) {
		const weight = furIn(surface).getX(vertex);
		expect(weight).toBeGreaterThan(0.2);
		const { x, y, z } = new Vector3().fromBufferAttribute(far.attributes.position as BufferAttribute, vertex);
		area.add([x, y, z].join());
	}
	expect(area.size).toBe((SIDE + 1) ** 2);
});

it('covers as all patches together do, and denser where they meet', () => {
	const surface = hill();
	const fur = furIn(new FarSurface(surface).geometry());
	for (let i = 0; i < fur.count; i++) {
		const weight = furIn(surface).getX(i);
		// Of two copies of weights w and 1 − w both have 1, and half of 2·w·(1 − w) more.
		expect(fur.getX(i)).toBeCloseTo(1 + weight * (1 - weight), 5);
		for (const c of [1, 2, 3]) expect(fur.getComponent(i, c)).toBe(furIn(surface).getComponent(i, c));
	}
});

it('leaves each of several furs its own faces and weights', () => {
	const surface = hill(2);
	const far = new FarSurface(surface).geometry();
	expect(facesIn(far)).toBe(facesIn(surface));
	expect([...furIn(far).array]).toEqual([...furIn(surface).array]);
});

it('leaves out the more faces the more the surface may move, and moves by about that', async () => {
	await MeshoptSimplifier.ready;
	const surface = hill();
	const far = new FarSurface(surface);
	let before = facesIn(far.geometry());
	for (const error of [2e-3, 8e-3]) {
		const fewer = far.geometry(MeshoptSimplifier, error);
		expect(facesIn(fewer)).toBeLessThan(0.8 * before);
		before = facesIn(fewer);
		const mesh = new Mesh(fewer);
		const ray = new Raycaster(new Vector3(), new Vector3(0, 0, -1));
		for (let i = 0; i < 50; i++) {
			const [u, v] = [(0.9 * ((i * 37) % 50)) / 50 - 0.45, (0.9 * i) / 50 - 0.45];
			ray.ray.origin.set(u, v, 1);
			const [hit] = ray.intersectObject(mesh);
			expect(Math.abs((hit?.point.z ?? Number.NaN) + 0.5 * (u * u + v * v))).toBeLessThan(2 * error);
		}
	}
});

it('has a fin on every edge, in tiles as wide as the shells have them, whatever fur the body wears', () => {
	const surface = hill();
	const far = new FarSurface(surface).geometry();
	/** A fur with hairs .2 long in tiles .25 wide, on a body that is baked with `tiles` a unit of its coordinates. */
	const worn = (tiles: number, finHeights: number) =>
		({
			asset: { drift: [[0, 0.1]], tiles, length: 0.2, height: 0.8 },
			shells: new Mesh(surface),
			ground: { finHeights, roots: undefined },
		}) as unknown as Fur;
	for (const [tiles, finHeights] of [
		[1, 1],
		[2, 1],
		[1, 3],
	] as const) {
		const { position, uv } = farFins(worn(tiles, finHeights), far, 1).attributes as Record<string, BufferAttribute>;
		expect(uv?.count).toBe(4 * new EdgeFaces(far).count);
		for (let fin = 0; fin < (uv?.count ?? 0); fin += 4) {
			const [a, b] = [fin, fin + 1].map((at) => new Vector3().fromBufferAttribute(position as BufferAttribute, at));
			const length = (a as Vector3).distanceTo(b as Vector3);
			expect(tiles * ((uv?.getX(fin + 1) ?? 0) - (uv?.getX(fin) ?? 0))).toBeCloseTo(length / 0.25, 4);
			expect([0, 1, 2, 3].map((end) => finHeights * (uv?.getY(fin + end) ?? 0)).map((v) => +v.toFixed(5))).toEqual([
				0, 0, 1, 1,
			]);
		}
	}
});
