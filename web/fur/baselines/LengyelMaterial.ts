import { type IUniform, type Texture, Vector2 } from 'three';
import type { FurMaterial } from '../FurMaterial.ts';
import kajiyaKay from './kajiya-kay.glsl?raw';
import fragmentShader from './lengyel.frag.glsl?raw';
import vertexShader from './lengyel.vert.glsl?raw';
import localIn from './local.frag.glsl?raw';
import localOut from './local.vert.glsl?raw';
import { RivalMaterial } from './RivalMaterial.ts';

/** Options of local light. */
export interface LocalLight {
	/** Mean unit vector along the texel's hairs, ½ + ½·(T, B, N); without it the mean over the slab serves. */
	direction?: Texture | undefined;
	/** Strength of the highlight; 0 costs nothing. */
	highlight?: number;
	/** Its exponent. */
	sharpness?: number;
}

/** What a mean direction has to be brightened by: of many hairs some always lie more across the light than their mean. */
const MEAN_DIFFUSE = 1.12;

/**
 * Of lamps and of the sky, 4π·radiance / (albedo·irradiance), and what of either is missing at the roots.
 *
 * Set so that bunny and tori are as bright on the whole as with polynomial texture maps. Of one picture it may be a fifth
 * more or less: where one part of the body shades another, where hairs point at the lamp.
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
		vertex: ['#include <lights_pars_begin>', kajiyaKay, localOut].join('\n'),
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
 * Light is found per fragment from the hair's direction, as Banks and as Kajiya and Kay have it; that hairs stand in each
 * other's shadow is in nothing but the darkness of the roots.
 */
export class LengyelMaterial extends RivalMaterial {
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
