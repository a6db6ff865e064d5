import { GLSL3, type IUniform, ShaderMaterial } from 'three';
import type { FurMaterial } from './FurMaterial.ts';
import body from './shaders/body.glsl?raw';
import displacement from './shaders/displacement.glsl?raw';
import fragmentShader from './shaders/hull.frag.glsl?raw';
import vertexShader from './shaders/hull.vert.glsl?raw';

/**
 * What fur casts a shadow with: its hull at half the hairs' length, without a hole. Where light gets between the hairs the
 * shadow's filter has its say.
 */
export class HullMaterial extends ShaderMaterial {
	constructor(shells: FurMaterial) {
		super({
			name: 'HullMaterial',
			glslVersion: GLSL3,
			uniforms: { furLength: shells.uniforms.furLength as IUniform },
			vertexShader: [body, displacement, vertexShader].join('\n'),
			fragmentShader,
		});
		Object.assign(this.defaultAttributeValues, { _fur: [1, 1, 1, 0], _comb: [0, 0, 0] });
	}
}
