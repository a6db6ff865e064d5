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
import curvature from '../shaders/draw/curvature.glsl?raw';
import output from '../shaders/draw/output.glsl?raw';
import colour from '../shaders/hair/colour.glsl?raw';
import frame from '../shaders/hair/frame.glsl?raw';
import hairIn from '../shaders/hair/hair.frag.glsl?raw';
import hairOut from '../shaders/hair/hair.vert.glsl?raw';
import opacity from '../shaders/hair/opacity.glsl?raw';
import shell from '../shaders/hair/shell.glsl?raw';
import drift from '../shaders/hair/tile/drift.glsl?raw';
import view from '../shaders/light/view.glsl?raw';
import { followEnvironmentMap } from '../shells/environmentMap.ts';
import type { FurMaterial } from '../shells/FurMaterial.ts';
import { hairChunks, texelChunks } from '../shells/parts/chunks.ts';
import { parts } from '../shells/parts/parts.ts';
import { followParts, SHAPE } from '../shells/switches.ts';
import coverage from './shaders/coverage.glsl?raw';

/**
 * Base of other ways to light the shells of a FurMaterial. Geometry, coverage, colour, blending and output share chunks,
 * uniforms and compiled parts with it, so that only the light differs and settings on either hold for both. Switches of its
 * light, and its blending, are copied at construction. Wet and dirty fur has lengths, coverage and colours of its state, and
 * directions of the dry hairs.
 */
export class BaselineMaterial extends ShaderMaterial {
	/**
	 * @param shells material to share textures, lengths, colours and number of shells with
	 * @param parameters own shaders (after the common chunks), uniforms and defines
	 */
	constructor(
		readonly shells: FurMaterial,
		{ uniforms, defines, vertexShader, fragmentShader, ...parameters }: ShaderMaterialParameters,
	) {
		// Nothing here depends on the comb.
		const { STRAIGHT: _, ...own } = shells.defines;
		super({
			glslVersion: shells.glslVersion,
			fog: shells.fog,
			uniforms: { ...shells.uniforms, ...UniformsUtils.clone(UniformsLib.lights), ...uniforms },
			defines: { ...own, ...defines },
			vertexShader: [
				'#include <common>',
				view,
				...hairChunks(),
				frame,
				drift,
				curvature,
				shell,
				colour,
				hairOut,
				vertexShader,
			].join('\n'),
			fragmentShader: [
				'#include <common>',
				...texelChunks(),
				coverage,
				...('ROOTS' in shells.defines || 'REGIONS' in shells.defines ? [drift] : []),
				parts.regions?.dissolve ?? '',
				opacity,
				colour,
				hairIn,
				output,
				fragmentShader,
			].join('\n'),
		});
		// Blending, depth and the like, without shaders.
		Material.prototype.copy.call(this, shells);
		Object.assign(this.defaultAttributeValues, shells.defaultAttributeValues);
		for (const [name, { get, set }] of Object.entries(Object.getOwnPropertyDescriptors(shells))) {
			if (get && set) Object.defineProperty(this, name, { enumerable: true, get, set });
		}
		this.setValues(parameters);
	}

	/** Density of the hairs; see PeltMaterial. */
	get density(): number {
		return this.shells.density;
	}

	set density(ratio: number) {
		this.shells.density = ratio;
	}

	/** Share of the hairs left after a cut; see PeltMaterial. */
	get trim(): number {
		return this.shells.trim;
	}

	set trim(share: number) {
		this.shells.trim = share;
	}

	/** Follow the shells' compiled parts, and the scene's environment. */
	override onBeforeRender(renderer: WebGLRenderer, scene: Scene, _camera: Camera): void {
		followParts(this, this.shells, SHAPE);
		followEnvironmentMap(this, renderer, scene);
	}
}
