import {
	BoxGeometry,
	BufferAttribute,
	DataTexture,
	DoubleSide,
	Mesh,
	MeshPhysicalMaterial,
	MeshStandardMaterial,
	SphereGeometry,
	Vector3,
} from 'three';
import { describe, expect, it } from 'vitest';
import { MatteMaterial } from '../../../../web/fur/body/skin/MatteMaterial.ts';
import { gatherPieces } from '../../../../web/fur/herd/pieces.ts';

const placement = (mesh: Mesh) => {
	mesh.updateMatrix();
	return mesh.matrix;
};

function body(): [Mesh<BoxGeometry, MeshStandardMaterial>, Mesh<SphereGeometry, MeshStandardMaterial>] {
	const skin = new Mesh(new BoxGeometry(), new MeshStandardMaterial({ side: DoubleSide, roughness: 0.5 }));
	skin.material.color.setRGB(0.5, 0.25, 1);
	skin.position.set(1, 2, 3);
	skin.scale.setScalar(2);
	const shade = Float32Array.from({ length: 24 * 3 }, (_, i) => i / 72);
	skin.geometry.setAttribute('color', new BufferAttribute(shade, 3));
	skin.material.vertexColors = true;
	const eye = new Mesh(new SphereGeometry(0.1, 8, 6), new MeshStandardMaterial({ roughness: 0.08, metalness: 0.3 }));
	eye.material.color.setRGB(0.02, 0.01, 0);
	eye.position.set(1, 3, 3.4);
	eye.rotation.set(0.3, 1, -2);
	eye.scale.set(1, 2, 0.5);
	return [skin, eye];
}

describe('pieces of a body', () => {
	it('without pictures become one, in which each vertex is what it was', () => {
		const meshes = body();
		const [piece, ...others] = gatherPieces(meshes, placement);
		expect(others).toEqual([]);
		if (!piece) return;
		const { position, normal, color, uv } = piece.geometry.attributes as Record<string, BufferAttribute>;
		const { roughnessMap, metalnessMap, side, roughness, metalness } = piece.material as MeshStandardMaterial;
		expect([side, roughness, metalness, metalnessMap]).toEqual([DoubleSide, 1, 1, roughnessMap]);
		const texels = (roughnessMap as DataTexture).image.data as Float32Array;
		const vector = new Vector3();
		let vertex = 0;
		let corner = 0;
		for (const mesh of meshes) {
			const { geometry, material } = mesh;
			const own = material.vertexColors ? geometry.getAttribute('color') : undefined;
			for (const i of geometry.index?.array ?? []) expect(piece.geometry.index?.getX(corner++)).toBe(vertex + i);
			for (let i = 0; i < geometry.getAttribute('position').count; i++, vertex++) {
				const place = new Vector3().fromBufferAttribute(position as BufferAttribute, vertex).applyMatrix4(piece.matrix);
				vector.fromBufferAttribute(geometry.getAttribute('position'), i).applyMatrix4(mesh.matrix);
				expect(place.distanceTo(vector)).toBeLessThan(1e-6);
				const turned = new Vector3().fromBufferAttribute(normal as BufferAttribute, vertex);
				vector.fromBufferAttribute(geometry.getAttribute('normal'), i);
				vector.applyNormalMatrix(mesh.normalMatrix.getNormalMatrix(mesh.matrix));
				expect(turned.dot(vector)).toBeCloseTo(1, 5);
				for (const [c, value] of material.color.toArray().entries())
					expect(color?.getComponent(vertex, c)).toBeCloseTo(value * (own?.getComponent(i, c) ?? 1), 6);
				const texel = Math.floor((uv?.getX(vertex) ?? 0) * 2) * 4;
				expect(texels[texel + 1]).toBeCloseTo(material.roughness, 6);
				expect(texels[texel + 2]).toBeCloseTo(material.metalness, 6);
			}
		}
		expect(vertex).toBe(position?.count);
		expect(corner).toBe(piece.geometry.index?.count);
	});

	it('share the shader of a class of their own, and the settings of the first', () => {
		class Glossy extends MeshStandardMaterial {}
		const [skin, eye] = body();
		eye.material = new Glossy().copy(eye.material);
		skin.material = MatteMaterial.of(skin.material);
		skin.material.name = 'skin';
		const [piece] = gatherPieces([skin, eye], placement);
		expect(piece?.material).toBeInstanceOf(Glossy);
		expect(piece?.material).toMatchObject({ name: 'skin', vertexColors: true, roughness: 1 });
		expect(eye.material.vertexColors).toBe(false);
	});

	it('take over the colours that their meshes get later', () => {
		const [skin, eye] = body();
		const [piece] = gatherPieces([skin, eye], placement);
		const colour = piece?.geometry.getAttribute('color') as BufferAttribute;
		const first = skin.geometry.getAttribute('position').count;
		const version = colour.version;
		piece?.follow();
		expect(colour.version, 'nothing is uploaded').toBe(version);
		// As wet fur does: the skin's material first, then its vertices, which had a colour, and at last other vertices.
		skin.material.color.setRGB(0.1, 0.2, 0.3);
		piece?.follow();
		const shade = skin.geometry.getAttribute('color') as BufferAttribute;
		expect(colour.getZ(5)).toBeCloseTo(0.3 * shade.getZ(5), 6);
		shade.setXYZ(5, 1, 0.5, 0.25).needsUpdate = true;
		piece?.follow();
		expect([colour.getX(5), colour.getY(5), colour.getZ(5)]).toEqual(
			[0.1, 0.1, 0.075].map((c) => expect.closeTo(c, 6)),
		);
		const count = eye.geometry.getAttribute('position').count;
		eye.geometry.setAttribute('color', new BufferAttribute(new Float32Array(3 * count).fill(0.5), 3));
		eye.material.vertexColors = true;
		piece?.follow();
		expect(colour.getX(first + 7)).toBeCloseTo(0.01, 6);
		expect(colour.version).toBeGreaterThan(version);
	});

	it('of which the first keeps its places to the bit', () => {
		const [skin, eye] = body();
		const [piece] = gatherPieces([skin, eye], placement);
		const places = skin.geometry.getAttribute('position').array as Float32Array;
		expect(piece?.geometry.getAttribute('position').array.slice(0, places.length)).toEqual(places);
		expect(piece?.matrix).toEqual(skin.matrix);
	});

	it('with pictures, glow, glass or vertices of more than colour stay alone', () => {
		const [skin, eye] = body();
		const [painted, glowing, glass, masked] = [body()[1], body()[1], body()[1], body()[1]] as [Mesh, Mesh, Mesh, Mesh];
		const others = [painted, glowing, glass, masked];
		painted.material = new MeshStandardMaterial({ map: new DataTexture() });
		glowing.material = new MeshStandardMaterial({ emissive: 0x101010 });
		glass.material = new MeshPhysicalMaterial();
		masked.geometry.setAttribute('_mask', new BufferAttribute(new Float32Array(1), 1));
		const pieces = gatherPieces([painted, skin, glowing, eye, glass, masked], placement);
		expect(pieces.map(({ mesh }) => mesh)).toEqual([skin, ...others]);
		expect(pieces.slice(1).map(({ geometry }) => geometry)).toEqual(others.map(({ geometry }) => geometry));
		expect(gatherPieces([skin], placement)[0]?.geometry).toBe(skin.geometry);
	});

	it('free what they made, and nothing else', () => {
		const [skin, eye] = body();
		const freed: string[] = [];
		for (const mesh of [skin, eye]) {
			mesh.geometry.addEventListener('dispose', () => freed.push('own'));
			mesh.material.addEventListener('dispose', () => freed.push('own'));
		}
		const [piece] = gatherPieces([skin, eye], placement);
		const material = piece?.material as MeshStandardMaterial;
		piece?.geometry.addEventListener('dispose', () => freed.push('geometry'));
		material.addEventListener('dispose', () => freed.push('material'));
		material.roughnessMap?.addEventListener('dispose', () => freed.push('palette'));
		piece?.dispose();
		expect(freed.sort()).toEqual(['geometry', 'material', 'palette']);
		gatherPieces([skin], placement)[0]?.dispose();
		expect(freed).not.toContain('own');
	});
});
