import { readFileSync } from 'node:fs';
import { type BufferAttribute, type BufferGeometry, Uint8BufferAttribute, Vector3 } from 'three';
import { expect, it } from 'vitest';
import { EdgeFaces } from '../../../../web/fur/fins/EdgeFaces.ts';
import { finQuads } from '../../../../web/fur/fins/finQuads.ts';
import { load } from '../furs.ts';

/** Stored by the baker as a mesh. */
const NAME = 'torus-4608';
const gltf = JSON.parse(readFileSync(new URL(`../../../../public/models/${NAME}/model.gltf`, import.meta.url), 'utf8'));
const asset = gltf.extensions.FUR_ptm_shells;
const shells = load(NAME).fur.shells.geometry;
const stored = load(NAME, 'fins').fur.shells.geometry;

const row = (geometry: BufferGeometry, name: string, vertex: number) => {
	const attribute = geometry.getAttribute(name) as BufferAttribute;
	return Array.from({ length: attribute.itemSize }, (_, c) => attribute.getComponent(vertex, c));
};
const place = (geometry: BufferGeometry, vertex: number) =>
	row(geometry, 'position', vertex)
		.map((value) => Math.round(value * 65535))
		.join();
const ends = (geometry: BufferGeometry, a: number, b: number) => [place(geometry, a), place(geometry, b)].sort().join();

/** Number of each stored fin by the places of its roots. */
const fins = new Map(
	Array.from({ length: stored.getAttribute('position').count / 4 }, (_, i) => [ends(stored, 4 * i, 4 * i + 1), i]),
);
const edges = [...new EdgeFaces(shells).edges];
const kept = edges.map(({ from, to }) => fins.has(ends(shells, from, to)));
const mask = new Uint8Array(Math.ceil(edges.length / 8));
for (const [i, keep] of kept.entries()) if (keep) mask[i >> 3] = (mask[i >> 3] as number) | (1 << (i & 7));

const places = {
	start: 0.25,
	tile: asset.length / asset.height / gltf.nodes[asset.shells].scale[0],
	lean: asset.drift.at(-1)[1],
	tiles: asset.tiles ?? 1,
};

it('makes of the edges the fins that the baker stores', () => {
	const made = finQuads(shells, mask, places);
	expect(made.getAttribute('position').count).toBe(stored.getAttribute('position').count);
	expect(made.index?.count).toBe(stored.index?.count);
	const off: Record<string, number> = {};
	const differ = (name: string, got: readonly number[], wanted: readonly number[], turn = 0) => {
		for (const [c, value] of got.entries()) {
			const apart = Math.abs(value - (wanted[c] as number));
			off[name] = Math.max(off[name] ?? 0, turn ? Math.min(apart, Math.abs(turn - apart)) : apart);
		}
	};
	const across = (u: readonly number[]) => [1, 2, 3].map((i) => ((u[i] as number) - (u[0] as number)) * places.tiles);
	let turned = 0;
	for (let i = 0; i < made.getAttribute('position').count / 4; i++) {
		const fin = fins.get(ends(made, 4 * i, 4 * i + 1)) as number;
		if (place(made, 4 * i) !== place(stored, 4 * fin)) {
			// Straight across the fur no end is the first.
			const sheared = (row(made, 'uv', 4 * i + 2)[0] as number) - (row(made, 'uv', 4 * i)[0] as number);
			expect((sheared * places.tiles) / places.lean).toBeGreaterThan(0.97);
			turned++;
			continue;
		}
		const columns = [made, stored].map((geometry, which) =>
			[0, 1, 2, 3].map((corner) => row(geometry, 'uv', 4 * (which ? fin : i) + corner)[0] as number),
		) as [number[], number[]];
		differ('u', across(columns[0]), across(columns[1]));
		for (let corner = 0; corner < 4; corner++) {
			const [at, from] = [4 * i + corner, 4 * fin + corner];
			for (const name of ['position', 'normal', 'tangent']) differ(name, row(made, name, at), row(stored, name, from));
			differ('_fur', row(made, '_fur', at), row(stored, '_fur', from), 1);
			differ('v', [row(made, 'uv', at)[1] as number], [row(stored, 'uv', from)[1] as number]);
			const [angles, wanted] = [row(made, '_edge', at), row(stored, '_edge', from)];
			differ('comb', angles.slice(2), wanted.slice(2));
			// The two faces come in any order.
			const apart = (one: number, two: number) =>
				Math.abs((angles[0] as number) - one) + Math.abs((angles[1] as number) - two);
			const [one = 0, two = 0] = wanted;
			off.angles = Math.max(off.angles ?? 0, Math.min(apart(one, two), apart(two, one)));
		}
	}
	expect(turned).toBeLessThan(fins.size / 3);
	expect(off.position).toBeLessThan(1e-6);
	for (const name of ['normal', 'tangent', '_fur', 'comb', 'angles']) expect(off[name] ?? 0, name).toBeLessThan(0.03);
	expect(off.v).toBeLessThan(1e-4);
	expect(off.u).toBeLessThan(0.02);
});

it('begins each fin a golden section after the one before, and refuses a mask of another mesh', () => {
	const uv = finQuads(shells, mask, places).getAttribute('uv');
	const starts = Array.from({ length: 8 }, (_, i) => Math.min(uv.getX(4 * i), uv.getX(4 * i + 1)) * places.tiles);
	for (const [i, start] of starts.entries()) expect(start).toBeCloseTo((0.25 + i * ((5 ** 0.5 - 1) / 2)) % 1, 5);
	expect(() => finQuads(shells, mask.slice(1), places)).toThrow(/got a mask of \d+ bytes, expected \d+ for \d+ edges/);
});

it('makes a border an outline to eyes outside of it', () => {
	const square = load('pelt-fox').fur.shells.geometry;
	const sides = [...new EdgeFaces(square).edges];
	const made = finQuads(square, Uint8Array.of(255), places);
	const middle = new Vector3(0.5, 0, 0.5);
	const vector = (name: string, fin: number) => new Vector3().fromArray(row(made, name, 4 * fin));
	const borders = [...sides.keys()].filter((i) => sides[i]?.one === sides[i]?.two);
	expect(borders).toHaveLength(4);
	for (const i of borders) {
		const [t, n] = [vector('tangent', i), vector('normal', i)];
		const angle = Math.PI * (row(made, '_edge', 4 * i)[1] as number);
		const second = t.cross(n).multiplyScalar(Math.sin(angle)).addScaledVector(n, Math.cos(angle));
		expect(second.dot(vector('position', i).sub(middle))).toBeCloseTo(-0.5, 6);
		expect(second.length()).toBeCloseTo(1, 6);
	}
});

it('takes the places of roots from one face of the shells', () => {
	const scale = [0.03, 0.05] as const;
	const made = finQuads(shells, mask, { ...places, roots: scale });
	expect(finQuads(shells, mask, places).hasAttribute('uv1')).toBe(false);
	const corners = shells.index?.array as ArrayLike<number>;
	const [across, down] = scale.map((each) => each * places.tiles) as [number, number];
	const key = (at: string, u: number, v: number) => `${at} ${u.toFixed(5)} ${v.toFixed(5)}`;
	const faces = new Set<string>();
	for (let i = 0; i < corners.length; i++) {
		const both = [corners[i] as number, corners[3 * Math.floor(i / 3) + ((i + 1) % 3)] as number].map((vertex) => {
			const [u = 0, v = 0] = row(shells, 'uv', vertex);
			return key(place(shells, vertex), u * across, v * down);
		});
		faces.add(both.sort().join());
	}
	for (let i = 0; i < made.getAttribute('position').count / 4; i += 16) {
		const both = [4 * i, 4 * i + 1].map((vertex) => {
			const [u = 0, v = 0] = row(made, 'uv1', vertex);
			expect(row(made, 'uv1', vertex + 2)).toEqual([u, v]);
			return key(place(made, vertex), u, v);
		});
		expect(faces.has(both.sort().join())).toBe(true);
	}
});

it('lets a fin follow the joints of its ends', () => {
	const moving = shells.clone();
	const { count } = moving.getAttribute('position');
	const joints = Float32Array.from({ length: 4 * count }, (_, i) => (Math.floor(i / 4) % 5) + (i % 4));
	moving.setAttribute('skinIndex', new Uint8BufferAttribute(Uint8Array.from(joints), 4));
	moving.setAttribute(
		'skinWeight',
		new Uint8BufferAttribute(
			Uint8Array.from(joints, (_, i) => [200, 55, 0, 0][i % 4] as number),
			4,
			true,
		),
	);
	const made = finQuads(moving, mask, places);
	for (let i = 0; i < made.getAttribute('position').count; i++) {
		const copies = Array.from({ length: count }, (_, vertex) => vertex).filter(
			(vertex) => place(moving, vertex) === place(made, i),
		);
		expect(copies.map((vertex) => `${row(moving, 'skinIndex', vertex)}`)).toContain(`${row(made, 'skinIndex', i)}`);
		expect(row(made, 'skinWeight', i)[0]).toBeCloseTo(200 / 255, 5);
		if (i > 400) break;
	}
	expect(finQuads(shells, mask, places).hasAttribute('skinIndex')).toBe(false);
});
