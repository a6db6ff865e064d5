/** Uniforms, defines, shaders and blending of the materials of shells and fins. */

import {
	Color,
	CustomBlending,
	GLSL3,
	type IUniform,
	LessEqualDepth,
	OneFactor,
	OneMinusSrcAlphaFactor,
	type ShaderMaterialParameters,
	UniformsLib,
	UniformsUtils,
	Vector2,
	Vector3,
} from 'three';
import { BODY_RADIUS } from '../../light/moments.ts';
import { basisDefines, CONTRAST, codings, type FurTextures, type TexelCoding } from '../../light/texels.ts';
import bodyLight from '../../shaders/draw/bodyLight.glsl?raw';
import curvature from '../../shaders/draw/curvature.glsl?raw';
import lightIn from '../../shaders/draw/light.frag.glsl?raw';
import lightOut from '../../shaders/draw/light.vert.glsl?raw';
import output from '../../shaders/draw/output.glsl?raw';
import colour from '../../shaders/hair/colour.glsl?raw';
import ptm from '../../shaders/light/ptm.glsl?raw';
import { stainUniforms } from '../../weather/stains.ts';
import { LOD_BIAS } from '../lod.ts';
import { hairChunks, lampChunks, skyChunks, texelChunks } from './chunks.ts';

/**
 * @param furs coding of each fur's texels, the coat first; of the coat alone where all have its hairs
 * @param light uniforms of the slabs' light
 * @param parameters own shaders (after the common chunks), uniforms, defines and properties
 */
// Long: one flat table of uniforms and defaults.
export function peltParameters(
	furs: readonly TexelCoding[],
	textures: FurTextures,
	light: Record<string, IUniform>,
	{ uniforms, defines, vertexShader, fragmentShader, ...parameters }: ShaderMaterialParameters,
): ShaderMaterialParameters {
	const texels = furs[0] as TexelCoding;
	const { means, basis } = texels;
	return {
		glslVersion: GLSL3,
		lights: true,
		fog: true,
		uniforms: {
			...UniformsUtils.clone({ ...UniformsLib.lights, ...UniformsLib.fog }),
			plane0: { value: null },
			plane1: { value: null },
			colourPlane: { value: null },
			...Object.fromEntries(Object.entries(codings(furs, CONTRAST)).map(([name, value]) => [name, { value }])),
			...light,
			bodyRadius: { value: BODY_RADIUS },
			lean: { value: new Vector2() },
			gloss: { value: 0 },
			sharpness: { value: 60 },
			backlight: { value: 0 },
			glow: { value: 0 },
			lampHue: { value: new Color(1, 1, 1) },
			environmentProbe: { value: Array.from({ length: 9 }, () => new Vector3()) },
			density: { value: 1 },
			swing: { value: null },
			...stainUniforms(),
			furTrim: { value: 1 },
			...uniforms,
		},
		defines: {
			...basisDefines(basis),
			...(means && { MEAN_CURVES: '' }),
			...(means?.multiple && { MULTIPLE: '' }),
			...(texels.scale.length > 3 && { TWO_PLANES: '' }),
			...(textures.colour && { COLOUR_PLANE: '' }),
			SKY: '',
			LOD_BIAS: LOD_BIAS.toFixed(1),
			...(furs.some((own) => String(own.scale) + own.bias !== String(texels.scale) + texels.bias) && { CODINGS: '' }),
			...defines,
		},
		vertexShader: [
			...hairChunks(),
			bodyLight,
			...lampChunks(means !== undefined),
			...skyChunks(means !== undefined),
			...[curvature, lightOut, colour, vertexShader],
		].join('\n'),
		fragmentShader: [
			...texelChunks(),
			...lampChunks(means !== undefined),
			...[lightIn, ptm, colour, output, fragmentShader],
		].join('\n'),
		transparent: true,
		blending: CustomBlending,
		blendSrc: OneFactor,
		blendDst: OneMinusSrcAlphaFactor,
		premultipliedAlpha: true,
		depthFunc: LessEqualDepth,
		...parameters,
	};
}
