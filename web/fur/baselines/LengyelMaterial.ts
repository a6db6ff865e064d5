import { type IUniform, type Texture, Vector2 } from 'three';
import environmentMap from '../shaders/light/environmentMap.glsl?raw';
import type { FurMaterial } from '../shells/FurMaterial.ts';
import { BaselineMaterial } from './BaselineMaterial.ts';
import kajiyaKay from './shaders/kajiya-kay.glsl?raw';
import fragmentShader from './shaders/lengyel.frag.glsl?raw';
import vertexShader from './shaders/lengyel.vert.glsl?raw';
import localIn from './shaders/local.frag.glsl?raw';
import localOut from './shaders/local.vert.glsl?raw';

/** Options of local light. */
export interface LocalLight {
	/** Mean unit vector along the texel's hairs, ½ + ½·(T, B, N); without it the mean over the slab serves. */
	direction?: Texture | undefined;
	/** Strength of the highlight; 0 costs nothing. */
	highlight?: number;
	/** Its exponent. */
	sharpness?: number;
}

/** Correction of the diffuse light on a mean direction: some hairs always lie more across the light than their mean. */
const MEAN_DIFFUSE = 1.12;

/**
 * Brightness under lamps and sky, 4π·radiance / (albedo·irradiance), and the share of either missing at the roots.
 *
 * Chosen so that bunny and tori are as bright on the whole as with polynomial texture maps. Single pictures differ by up
 * to a fifth: where one part of the body shades another, where hairs point at the lamp.
 */
export interface Brightness {
	diffuse: number;
	skyDiffuse: number;
	darkness: Vector2;
}

/** Chunks, uniforms and defines of hairs in local light. */
export function localLight(
	shells: FurMaterial,
	{ direction, highlight = 0, sharpness = 60 }: LocalLight,
	{ diffuse, skyDiffuse, darkness }: Brightness,
): { vertex: string; fragment: string; uniforms: Record<string, IUniform>; defines: Record<string, string> } {
	return {
		vertex: ['#include <lights_pars_begin>', environmentMap, kajiyaKay, localOut].join('\n'),
		fragment: ['#include <lights_pars_begin>', kajiyaKay, localIn].join('\n'),
		uniforms: {
			lean: shells.uniforms.lean as IUniform,
			directionPlane: { value: direction ?? null },
			diffuse: { value: direction ? diffuse : MEAN_DIFFUSE * diffuse },
			skyDiffuse: { value: skyDiffuse },
			darkness: { value: darkness },
			highlight: { value: highlight },
			sharpness: { value: sharpness },
		},
		defines: { ...(!direction && { MEAN_STRAND: '' }), ...(highlight > 0 && { HIGHLIGHT: '' }) },
	};
}

/**
 * Shells in local light, darkened from the tips to the roots. J. Lengyel, E. Praun, A. Finkelstein, H. Hoppe: Real-Time Fur
 * over Arbitrary Surfaces, Symposium on Interactive 3D Graphics 2001.
 *
 * Light follows per fragment from the hair's direction by Banks and by Kajiya and Kay; the darkness of the roots alone
 * stands for the shadows between hairs.
 */
export class LengyelMaterial extends BaselineMaterial {
	constructor(shells: FurMaterial, options: LocalLight = {}) {
		const { vertex, fragment, uniforms, defines } = localLight(shells, options, {
			diffuse: 2.75,
			skyDiffuse: 2.9,
			darkness: new Vector2(0.6, 0.6),
		});
		super(shells, {
			name: 'LengyelMaterial',
			lights: true,
			vertexShader: `${vertex}\n${vertexShader}`,
			fragmentShader: `${fragment}\n${fragmentShader}`,
			uniforms,
			defines,
		});
	}
}
