import { Group, Mesh, MeshStandardMaterial, SphereGeometry, Vector3 } from 'three';
import { expect, it } from 'vitest';
import { keepThinFurParts } from '../../../../../web/fur/body/skin/thin.ts';
import { gatherPieces } from '../../../../../web/fur/herd/pieces.ts';

it('a whisker has its axis and its end at the body, an eye has none', () => {
	const eye = new Mesh(new SphereGeometry(1, 8, 6), new MeshStandardMaterial());
	const whisker = new Mesh(new SphereGeometry(1, 8, 6), new MeshStandardMaterial());
	whisker.scale.set(0.05, 2, 0.05);
	whisker.position.set(0, 4, 0);
	for (const mesh of [eye, whisker]) mesh.updateMatrix();
	const [piece] = gatherPieces([eye, whisker], (mesh) => mesh.matrix);
	expect(piece?.thin).toBe(true);
	const { position, spine, spineRoot } = piece?.geometry.attributes ?? {};
	const first = eye.geometry.getAttribute('position').count;
	for (let i = 0; i < (position?.count ?? 0); i++) {
		const thin = i >= first;
		expect(spine?.getW(i)).toBeCloseTo(thin ? 0.05 : 0, 5);
		if (!thin || !position || !spine || !spineRoot) continue;
		const aside = new Vector3()
			.fromBufferAttribute(position, i)
			.sub(new Vector3().fromBufferAttribute(spine as never, i));
		expect(aside.y).toBeCloseTo(0, 5);
		expect([spineRoot.getX(i), spineRoot.getY(i)]).toEqual([expect.closeTo(0, 5), expect.closeTo(2, 5)]);
	}
});

it('thin parts of one body are kept in sight, and a herd merges them as before', () => {
	const body = new Group();
	const white = new MeshStandardMaterial();
	const [eye, first, second] = [0, 1, 2].map((x) => {
		const part = new Mesh(new SphereGeometry(1, 8, 6), white);
		part.scale.set(0.05, x ? 2 : 0.05, 0.05);
		part.position.set(x, x && 4, 0);
		return part as Mesh;
	}) as [Mesh, Mesh, Mesh];
	body.scale.setScalar(3);
	body.add(eye, first, second);
	keepThinFurParts(body, [eye, first, second]);
	expect(eye.material).toBe(white);
	expect(eye.geometry.hasAttribute('spine')).toBe(false);
	expect(first.material).not.toBe(white);
	expect(first.material).toBe(second.material);
	const { position, spine, spineRoot } = first.geometry.attributes;
	for (let i = 0; i < (position?.count ?? 0); i++) {
		// In the part's own axes: half as wide as it is there, and its end towards the body.
		expect([spine?.getX(i), spine?.getZ(i), spine?.getW(i)]).toEqual([0, 0, 1].map((of) => expect.closeTo(of, 5)));
		expect(spine?.getY(i)).toBeCloseTo(position?.getY(i) ?? Number.NaN, 5);
		expect(spineRoot?.getY(i)).toBeCloseTo(-1, 5);
	}
	const pieces = gatherPieces([eye, first, second], (mesh) => mesh.matrix);
	expect(pieces.map(({ thin }) => thin)).toEqual([true]);
	expect(Object.hasOwn(pieces[0]?.material ?? {}, 'onBeforeCompile')).toBe(false);
});
