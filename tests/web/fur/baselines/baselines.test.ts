/** Rivals of polynomial texture maps: what they share with the shells' own material, as far as that needs no GPU. */

import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { AdditiveBlending, BufferAttribute, BufferGeometry, Mesh, Object3D, Texture } from 'three';
import { describe, expect, it } from 'vitest';
import { type FurMethodTarget, furMethod } from '../../../../web/fur/baselines/furMethod.ts';
import { LengyelMaterial } from '../../../../web/fur/baselines/LengyelMaterial.ts';
import { UnlitMaterial } from '../../../../web/fur/baselines/UnlitMaterial.ts';
import { parseFur } from '../../../../web/fur/format/extension.ts';
import { FurMaterial } from '../../../../web/fur/shells/FurMaterial.ts';
import { FurShells } from '../../../../web/fur/shells/FurShells.ts';

const at = (path: string) => fileURLToPath(new URL(`../../../../${path}`, import.meta.url));
const gltf = JSON.parse(readFileSync(at('tests/golden/ptm-6/model.gltf'), 'utf8'));

function grow(direction?: Texture): FurMethodTarget {
	const asset = parseFur(gltf.extensions.FUR_ptm_shells);
	if (!asset) throw new Error('of another version');
	const textures = { plane0: new Texture(), plane1: new Texture(), direction };
	const surface = new BufferGeometry();
	for (const name of ['position', 'normal']) surface.setAttribute(name, new BufferAttribute(new Float32Array(9), 3));
	const shells = new FurShells(surface, new Object3D(), asset, new FurMaterial(asset, textures));
	return { textures, shells, skin: new Mesh(surface), method: undefined };
}

describe('a rival material', () => {
	it('follows the shells, and they it', () => {
		const { shells } = grow();
		const own = shells.material;
		const rival = new UnlitMaterial(own);
		own.furLength = 0.7;
		expect(rival.uniforms.furLength?.value).toBe(0.7);
		Object.assign(rival, { furLength: 0.4 });
		expect(own.furLength).toBe(0.4);
		furMethod({ ...grow(), shells }, 'unlit').apply();
		shells.shellCount = 7;
		expect(own.shellCount).toBe(7);
		expect(rival.uniforms.shellCount?.value).toBe(7);
	});

	it('has lights of its own: another scene may have others', () => {
		const { material } = grow().shells;
		expect(new LengyelMaterial(material).uniforms.directionalLights).not.toBe(material.uniforms.directionalLights);
	});

	it('is blended as the shells are', () => {
		const { material } = grow().shells;
		material.blending = AdditiveBlending;
		material.alphaToCoverage = true;
		const rival = new UnlitMaterial(material);
		for (const name of [
			'blending',
			'blendSrc',
			'blendDst',
			'depthWrite',
			'depthFunc',
			'alphaToCoverage',
			'side',
		] as const) {
			expect(rival[name], name).toBe(material[name]);
		}
		expect(rival.name).toBe('UnlitMaterial');
	});

	it('has one vertex of a shell, one opacity and one output with them', () => {
		const { material } = grow().shells;
		const rival = new LengyelMaterial(material);
		for (const chunk of ['hair/shell', 'hair/displacement']) {
			const text = readFileSync(at(`web/fur/shaders/${chunk}.glsl`), 'utf8');
			for (const shader of [material, rival]) expect(shader.vertexShader, chunk).toContain(text);
		}
		for (const chunk of ['hair/opacity', 'draw/output']) {
			const text = readFileSync(at(`web/fur/shaders/${chunk}.glsl`), 'utf8');
			for (const shader of [material, rival]) expect(shader.fragmentShader, chunk).toContain(text);
		}
	});

	it("takes the asset's directions where it has them, the slab's mean where not", () => {
		const direction = new Texture();
		const [directed, mean] = [grow(direction), grow()].map((fur) => furMethod(fur, 'lengyel').material);
		expect(directed?.uniforms.directionPlane?.value).toBe(direction);
		expect(directed?.defines).not.toHaveProperty('MEAN_STRAND');
		expect(mean?.defines).toHaveProperty('MEAN_STRAND');
	});
});

describe('a method', () => {
	it('gives the shells their own material back', () => {
		const fur = grow();
		const own = fur.shells.material;
		const unlit = furMethod(fur, 'unlit');
		unlit.apply();
		expect(fur.shells.material).toBe(unlit.material);
		const lengyel = furMethod(fur, 'lengyel');
		expect(furMethod(fur, 'ptm').material).toBe(own);
		lengyel.apply();
		unlit.dispose();
		expect(fur.shells.material).toBe(lengyel.material);
		lengyel.dispose();
		expect(fur.shells.material).toBe(own);
	});

	it('is what the fur updates, from its application to its end', () => {
		const fur = grow();
		const method = furMethod(fur, 'unlit');
		expect(fur.method).toBeUndefined();
		method.apply();
		expect(fur.method).toBe(method);
		method.dispose();
		expect(fur.method).toBeUndefined();
	});

	it('has no other name', () => {
		expect(() => furMethod(grow(), 'phong' as 'ptm')).toThrow(
			'furMethod: got phong, expected ptm, unlit, lengyel or shadow-layers',
		);
	});

	it('says that its maps need a renderer', () => {
		expect(() => furMethod(grow(), 'shadow-layers')).toThrow(
			'furMethod: got shadow-layers without a renderer, expected the option renderer',
		);
	});

	it('leaves the own material alone when it is that', () => {
		const fur = grow();
		let freed = false;
		fur.shells.material.addEventListener('dispose', () => {
			freed = true;
		});
		const ptm = furMethod(fur, 'ptm');
		ptm.apply();
		ptm.dispose();
		expect(freed).toBe(false);
	});
});

it('layers of opacity follow each other without gap or overlap, each deeper than the one before', () => {
	const text = readFileSync(at('web/fur/baselines/shaders/deep/deepOpacity.glsl'), 'utf8');
	const [from = [], depth = []] = ['FROM', 'DEPTH'].map((name) =>
		(new RegExp(`LAYER_${name} = vec4\\(([^)]*)\\)`).exec(text)?.[1] ?? '').split(',').map(Number),
	);
	expect(from).toHaveLength(4);
	expect(from[0]).toBe(0);
	for (let k = 1; k < 4; k++) {
		expect((from[k - 1] ?? 0) + (depth[k - 1] ?? 0)).toBeCloseTo(from[k] ?? 0, 12);
		expect(depth[k]).toBeGreaterThan(depth[k - 1] ?? 0);
	}
});
