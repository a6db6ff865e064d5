import type { FurMaterial } from '../FurMaterial.ts';
import { RivalMaterial } from './RivalMaterial.ts';
import fragmentShader from './unlit.frag.glsl?raw';
import vertexShader from './unlit.vert.glsl?raw';

/** Shells with their colour alone, one fetch a fragment: the limit of what any light can cost. */
export class UnlitMaterial extends RivalMaterial {
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
