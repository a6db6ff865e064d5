import {
	type Camera,
	Material,
	type Scene,
	ShaderMaterial,
	type ShaderMaterialParameters,
	UniformsLib,
	UniformsUtils,
	type WebGLRenderer,
} from 'three';
import { hairChunks, texelChunks } from '../chunks.ts';
import type { FurMaterial } from '../FurMaterial.ts';
import colour from '../shaders/colour.glsl?raw';
import hairIn from '../shaders/hair.frag.glsl?raw';
import hairOut from '../shaders/hair.vert.glsl?raw';
import opacity from '../shaders/opacity.glsl?raw';
import output from '../shaders/output.glsl?raw';
import shell from '../shaders/shell.glsl?raw';
import view from '../shaders/view.glsl?raw';
import { followParts, SHAPE } from '../switches.ts';
import coverage from './coverage.glsl?raw';

/**
 * The shells of a FurMaterial in another light: geometry, coverage, colour, blending and output are the same chunks with the
 * same uniforms, so that only the light differs, and what is set on either holds for both, what is compiled in for it included.
 * Switches of the FurMaterial's light, and its blending, are taken as they stand when the rival is made.
 * Of wet and dirty fur they have lengths, coverage and colours; directions of the hairs are those of the dry.
 */
export class RivalMaterial extends ShaderMaterial {
	/**
	 * @param shells whose textures, lengths, colours and number of shells this material has
	 * @param parameters own shaders (after the common chunks), uniforms and defines
	 */
	constructor(
		readonly shells: FurMaterial,
		{ uniforms, defines, vertexShader, fragmentShader, ...parameters }: ShaderMaterialParameters,
	) {
		super({
			glslVersion: shells.glslVersion,
			uniforms: { ...shells.uniforms, ...UniformsUtils.clone(UniformsLib.lights), ...uniforms },
			defines: { ...shells.defines, ...defines },
			vertexShader: ['#include <common>', view, ...hairChunks, shell, colour, hairOut, vertexShader].join('\n'),
			fragmentShader: [
				'#include <common>',
				...texelChunks,
				coverage,
				opacity,
				colour,
				hairIn,
				output,
				fragmentShader,
			].join('\n'),
		});
		// Blending, depth and the like: those of every material, no shaders.
		Material.prototype.copy.call(this, shells);
		Object.assign(this.defaultAttributeValues, shells.defaultAttributeValues);
		for (const [name, { get, set }] of Object.entries(Object.getOwnPropertyDescriptors(shells))) {
			if (get && set) Object.defineProperty(this, name, { enumerable: true, get, set });
		}
		this.setValues(parameters);
	}

	/** As of the shells. */
	get density(): number {
		return this.shells.density;
	}

	set density(ratio: number) {
		this.shells.density = ratio;
	}

	/** As of the shells. */
	get trim(): number {
		return this.shells.trim;
	}

	set trim(share: number) {
		this.shells.trim = share;
	}

	/** Has hairs where the shells have them. */
	override onBeforeRender(_renderer: WebGLRenderer, _scene: Scene, _camera: Camera): void {
		followParts(this, this.shells, SHAPE);
	}
}
