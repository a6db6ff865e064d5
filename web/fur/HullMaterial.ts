import { FrontSide, GLSL3, type IUniform, ShaderMaterial, type ShaderMaterialParameters } from 'three';
import { hairChunks } from './chunks.ts';
import type { FurMaterial } from './FurMaterial.ts';
import fragmentShader from './shaders/hull.frag.glsl?raw';
import vertexShader from './shaders/hull.vert.glsl?raw';
import { followParts } from './switches.ts';

/** What hulls have from the shells that they stand for. */
const SHARED = ['furLength', 'furTrim', 'swing', 'stains', 'wetnesses', 'traits'];

/** Parts of the shells' shaders that change a hull. */
const PARTS = ['SWING', 'TRIMMED', 'WET'];

/**
 * What fur casts a shadow with: its hull at three quarters of the hairs' length, where what light grazes of them hides half of it.
 * It has no hole.
 */
export class HullMaterial extends ShaderMaterial {
	readonly #shells: FurMaterial;

	/** @param parameters other shaders (the vertex shader's after the common chunks) and properties */
	constructor(shells: FurMaterial, parameters: ShaderMaterialParameters = {}) {
		super({
			name: 'HullMaterial',
			glslVersion: GLSL3,
			fragmentShader,
			...parameters,
			uniforms: Object.fromEntries(SHARED.map((name) => [name, shells.uniforms[name] as IUniform])),
			vertexShader: [...hairChunks, parameters.vertexShader ?? vertexShader].join('\n'),
		});
		this.#shells = shells;
		Object.assign(this.defaultAttributeValues, shells.defaultAttributeValues);
	}

	/**
	 * Bends hairs where the shells do. To be called before it is drawn.
	 *
	 * Its outside casts: the far side of a head lies in the hairs of the neck below, and leaves it no shadow. (The renderer
	 * takes the inside for every shadow anew.)
	 */
	follow(): void {
		this.side = FrontSide;
		followParts(this, this.#shells, PARTS);
	}
}
