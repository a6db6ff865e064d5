import type { FurMaterial } from '../shells/FurMaterial.ts';
import { BaselineMaterial } from './BaselineMaterial.ts';
import fragmentShader from './shaders/unlit.frag.glsl?raw';
import vertexShader from './shaders/unlit.vert.glsl?raw';

/** Shells with their colour alone, one fetch a fragment: the lower limit of the cost of any light. */
export class UnlitMaterial extends BaselineMaterial {
	/** @param brightness radiance of a white hair */
	constructor(shells: FurMaterial, { brightness = 1 } = {}) {
		super(shells, {
			name: 'UnlitMaterial',
			vertexShader,
			fragmentShader,
			uniforms: { brightness: { value: brightness } },
		});
	}
}
