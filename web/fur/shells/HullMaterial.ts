import { FrontSide, GLSL3, type IUniform, ShaderMaterial, type ShaderMaterialParameters } from 'three';
import fragmentShader from '../shaders/draw/hull.frag.glsl?raw';
import vertexShader from '../shaders/draw/hull.vert.glsl?raw';
import type { FurMaterial } from './FurMaterial.ts';
import { hairChunks } from './parts/chunks.ts';
import { followParts } from './switches.ts';

/** Uniforms shared with the shells. */
const SHARED = [
	...['furLength', 'furTrim', 'swing', 'stains', 'wetnesses', 'traits'],
	...['morphDeltas', 'morphUnit', 'morphCount', 'morphs'],
];

/** Parts of the shells' shaders that change a hull. */
const PARTS = ['SWING', 'TRIMMED', 'WET', 'MORPHS'];

/**
 * Shadow caster of fur: a closed hull at three quarters of the hairs' length, where hairs hide half of grazing light.
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
			vertexShader: [...hairChunks(), parameters.vertexShader ?? vertexShader].join('\n'),
		});
		this.#shells = shells;
		Object.assign(this.defaultAttributeValues, shells.defaultAttributeValues);
	}

	/**
	 * Follows the shells' bend. Call it before each draw.
	 *
	 * Casts with its outside, set again for every shadow since the renderer resets it to the inside: the far side of a head
	 * lies in the hairs of the neck below and would leave it no shadow.
	 */
	follow(): void {
		this.side = FrontSide;
		followParts(this, this.#shells, PARTS);
	}
}
