/** Parts beside skin and fur mirror the sky; what has a mirror of its own, or none, stays as it is. */

import {
	Mesh,
	MeshBasicMaterial,
	MeshStandardMaterial,
	ShaderChunk,
	ShaderLib,
	Texture,
	type WebGLProgramParametersWithUniforms,
} from 'three';
import { expect, it } from 'vitest';
import { GleamMaterial, gleam } from '../../../web/scene/gleam.ts';

const of = (material: MeshStandardMaterial | MeshBasicMaterial) => new Mesh(undefined, material);

it('gives standard materials a mirror once, shared parts one for both', () => {
	const eye = new MeshStandardMaterial({ roughness: 0.1, color: 0x123456, name: 'eye' });
	const [right, left] = [of(eye), of(eye)];
	gleam([right, left]);
	expect(right.material).toBeInstanceOf(GleamMaterial);
	expect(right.material).toBe(left.material);
	expect(right.material).toMatchObject({ type: 'MeshStandardMaterial', roughness: 0.1, name: 'eye' });
	expect((right.material as GleamMaterial).color.getHex()).toBe(0x123456);
	const before = right.material;
	gleam([right]);
	expect(right.material).toBe(before);
	expect(before.clone()).toBeInstanceOf(GleamMaterial);
});

it('adds each piece of its shader once, and nothing to what other materials share', () => {
	const chunks = { ...ShaderChunk };
	const { vertexShader, fragmentShader } = ShaderLib.physical;
	const shader = { vertexShader, fragmentShader } as WebGLProgramParametersWithUniforms;
	new GleamMaterial().onBeforeCompile(shader);
	expect(shader.vertexShader.split('varying vec3 vFront')).toHaveLength(2);
	expect(shader.vertexShader.split('vFront = normalize')).toHaveLength(2);
	expect(shader.fragmentShader.split('varying vec3 vFront')).toHaveLength(2);
	expect(shader.fragmentShader.split('radiance += RECIPROCAL_PI')).toHaveLength(2);
	expect(shader.fragmentShader.split('float glint')).toHaveLength(2);
	expect({ ...ShaderChunk }).toEqual(chunks);
	expect(ShaderLib.physical).toMatchObject({ vertexShader, fragmentShader });
	const plain = new MeshStandardMaterial();
	expect(new GleamMaterial().customProgramCacheKey()).not.toBe(plain.customProgramCacheKey());
});

it('leaves reflections, flat faces and other materials alone', () => {
	const mirror = new MeshStandardMaterial({ envMap: new Texture() });
	const flat = new MeshStandardMaterial({ flatShading: true });
	const basic = new MeshBasicMaterial();
	const parts = [mirror, flat, basic].map(of);
	gleam(parts);
	expect(parts.map(({ material }) => material)).toEqual([mirror, flat, basic]);
	for (const { material } of parts) expect(material).not.toBeInstanceOf(GleamMaterial);
});
