/** Parts beside skin and fur mirror the sky; what has a mirror of its own, or none, stays as it is. */

import { Mesh, MeshBasicMaterial, MeshStandardMaterial, ShaderChunk, Texture } from 'three';
import { expect, it } from 'vitest';
import { gleam } from '../../../web/scene/gleam.ts';

const of = (material: MeshStandardMaterial | MeshBasicMaterial) => new Mesh(undefined, material);

it('marks standard materials once, and keeps their other defines', () => {
	const eye = new MeshStandardMaterial({ roughness: 0.1 });
	eye.defines = { ...eye.defines, OTHER: '1' };
	gleam([of(eye), of(eye)]);
	const { version } = eye;
	expect(eye.defines).toMatchObject({ STANDARD: '', OTHER: '1', GLEAM: '' });
	gleam([of(eye)]);
	expect(eye.version).toBe(version);
	for (const chunk of ['normal_pars_vertex', 'normal_pars_fragment', 'normal_vertex', 'lights_fragment_end'] as const)
		expect(ShaderChunk[chunk].split('#ifdef GLEAM'), chunk).toHaveLength(2);
});

it('leaves reflections, flat faces and other materials alone', () => {
	const mirror = new MeshStandardMaterial({ envMap: new Texture() });
	const flat = new MeshStandardMaterial({ flatShading: true });
	const basic = new MeshBasicMaterial();
	gleam([mirror, flat, basic].map(of));
	for (const material of [mirror, flat, basic]) expect(material.defines?.GLEAM).toBeUndefined();
});
