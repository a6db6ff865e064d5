import {
	Color,
	CustomBlending,
	GLSL3,
	type IUniform,
	LessEqualDepth,
	OneFactor,
	OneMinusSrcAlphaFactor,
	ShaderMaterial,
	type ShaderMaterialParameters,
	type Texture,
	UniformsLib,
	UniformsUtils,
	Vector2,
	Vector3,
	Vector4,
} from 'three';
import { channelOf, type FurAsset } from './format.ts';
import { BODY_RADIUS } from './moments.ts';
import displacement from './shaders/displacement.glsl?raw';
import moments from './shaders/moments.glsl?raw';
import ptm from './shaders/ptm.glsl?raw';
import fragmentMain from './shaders/shells.frag.glsl?raw';
import vertexMain from './shaders/shells.vert.glsl?raw';

/** Coverage below which a fragment is dropped; the mip levels of the planes are made for it. */
export const ALPHA_CUT = 0.1;

export interface FurTextures {
	plane0: Texture;
	plane1?: Texture | undefined;
	colour?: Texture | undefined;
}

/** Properties that a FurMaterial has beside those of every material. */
export interface FurMaterialParameters extends ShaderMaterialParameters {
	/** Longest fur, the mesh's own units. */
	furLength?: number;
	/** Slabs of the pelt that one drawn shell stands for. */
	slabsPerShell?: number;
	/** Coverage below which a fragment is dropped, 0..1. */
	alphaCut?: number;
	/** Radius of the body in lengths of its fur: where tips lose the light when it sinks below their horizon. */
	bodyRadius?: number;
	/** Base colour of the model, which multiplies the fur's. */
	skinColour?: Color;
	/** Colour at the skin and at the tips, where the pelt has no colour plane. */
	root?: Color;
	tip?: Color;
	rampPower?: number;
}

const MIRRORED = [
	'furLength',
	'slabsPerShell',
	'alphaCut',
	'bodyRadius',
	'skinColour',
	'root',
	'tip',
	'rampPower',
] as const satisfies (keyof FurMaterialParameters)[];

/**
 * Shells of fur lit by polynomial texture maps (Tang, Li, Lv 2009), under three's own lights.
 *
 * Per vertex the lights are summed into a few moments; per fragment a texel's coefficients meet them in one dot
 * product. Colours are linear, blending is premultiplied, depth is written: shells have to be drawn inside-out.
 */
export class FurMaterial extends ShaderMaterial {
	declare furLength: number;
	declare slabsPerShell: number;
	declare alphaCut: number;
	declare bodyRadius: number;
	declare skinColour: Color;
	declare root: Color;
	declare tip: Color;
	declare rampPower: number;

	constructor(asset: FurAsset, textures: FurTextures, parameters: FurMaterialParameters = {}) {
		const pelt = asset.pelts[0];
		if (!pelt) throw new Error('FUR_ptm_shells/pelts: got none, expected at least one');
		const { scale, offset } = decoder(pelt.scale, pelt.bias);
		super({
			name: 'FurMaterial',
			glslVersion: GLSL3,
			lights: true,
			uniforms: UniformsUtils.merge([
				UniformsLib.lights,
				{
					plane0: { value: null },
					plane1: { value: null },
					colourPlane: { value: null },
					scale0: { value: scale[0] },
					offset0: { value: offset[0] },
					scale1: { value: new Vector2(scale[1]?.x, scale[1]?.y) },
					offset1: { value: new Vector2(offset[1]?.x, offset[1]?.y) },
					...momentUniforms(asset),
					furLength: { value: asset.length },
					slabsPerShell: { value: 1 },
					alphaCut: { value: ALPHA_CUT },
					bodyRadius: { value: BODY_RADIUS },
					skinColour: { value: new Color(1, 1, 1) },
					root: { value: new Color(...asset.ramp.root) },
					tip: { value: new Color(...asset.ramp.tip) },
					rampPower: { value: asset.ramp.power },
				},
			]),
			defines: {
				MAX_SLANT: '6.0',
				...(asset.basis.kind === 'eigen' && { BASIS_EIGEN: '' }),
				...(asset.coefficients > 3 && { TWO_PLANES: '' }),
				...(textures.colour && { COLOUR_PLANE: '' }),
			},
			vertexShader: ['#include <common>', '#include <lights_pars_begin>', displacement, moments, vertexMain].join('\n'),
			fragmentShader: ['#include <common>', ptm, fragmentMain].join('\n'),
			transparent: true,
			blending: CustomBlending,
			blendSrc: OneFactor,
			blendDst: OneMinusSrcAlphaFactor,
			premultipliedAlpha: true,
			depthWrite: true,
			depthFunc: LessEqualDepth,
		});
		Object.assign(this.defaultAttributeValues, { _weight: [1], _length: [1] });
		for (const name of MIRRORED) {
			const uniform = this.uniforms[name];
			if (!uniform) continue;
			Object.defineProperty(this, name, {
				enumerable: true,
				get: () => uniform.value,
				set: (value) => {
					uniform.value = value;
				},
			});
		}
		this.setTextures(textures);
		this.setValues(parameters);
	}

	/** Other planes of the same shape, of another state of the fur say. */
	setTextures({ plane0, plane1, colour }: FurTextures): void {
		for (const [name, value] of Object.entries({ plane0, plane1: plane1 ?? null, colourPlane: colour ?? null })) {
			const uniform = this.uniforms[name];
			if (uniform) uniform.value = value;
		}
	}
}

/** The light moments' matrices, coefficients 0..2 in `Low` and 3..5 in `High`, absent ones 0. */
function momentUniforms({ environment, basis, coefficients }: FurAsset): Record<string, IUniform> {
	const uniforms: Record<string, IUniform> = {};
	for (const [part, first] of [
		['Low', 0],
		['High', 3],
	] as const) {
		const zeros = new Array<number>(9).fill(0);
		const rows = [0, 1, 2, 3].map((i) => (i < 3 && environment[first + i]) || zeros);
		uniforms[`environment${part}0`] = { value: rows.flatMap((row) => row.slice(0, 4)) };
		uniforms[`environment${part}1`] = { value: rows.flatMap((row) => row.slice(4, 8)) };
		uniforms[`environment${part}2`] = { value: new Vector3(...rows.slice(0, 3).map((row) => row[8] ?? 0)) };
		if (basis.kind === 'eigen') {
			const curves = [0, 1, 2].map((i) => (first + i < coefficients ? basis.matrix[first + i] : undefined));
			const terms = basis.matrix[0]?.length ?? 0;
			uniforms[`curves${part}`] = {
				value: Array.from({ length: terms }, (_, t) => new Vector3(...curves.map((row) => row?.[t] ?? 0))),
			};
		}
	}
	return uniforms;
}

/** λ and Ω as multiply-adds on the GPU's 0..1 texels, per plane: a = texel·(255λ) − λΩ. */
function decoder(scale: number[], bias: number[]): { scale: Vector4[]; offset: Vector4[] } {
	const vectors = {
		scale: [new Vector4(0, 0, 0, 0), new Vector4(0, 0, 0, 0)],
		offset: [new Vector4(0, 0, 0, 0), new Vector4(0, 0, 0, 0)],
	};
	scale.forEach((lambda, i) => {
		const { plane, channel } = channelOf(i);
		vectors.scale[plane]?.setComponent(channel, lambda * 255);
		vectors.offset[plane]?.setComponent(channel, -lambda * (bias[i] ?? 0));
	});
	return vectors;
}
