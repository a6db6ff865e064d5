import { Mesh, MeshStandardMaterial, SphereGeometry, Vector3 } from 'three';
import { expect, it } from 'vitest';
import { gatherPieces } from '../../../../web/fur/herd/pieces.ts';

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
