import { Color, type ShaderMaterialParameters } from 'three';
import type { FurAsset } from './format.ts';
import { BODY_RADIUS } from './moments.ts';
import { type FurTextures, PeltMaterial } from './PeltMaterial.ts';
import opacity from './shaders/opacity.glsl?raw';
import shell from './shaders/shell.glsl?raw';
import fragmentMain from './shaders/shells.frag.glsl?raw';
import vertexMain from './shaders/shells.vert.glsl?raw';

/** Coverage below which a fragment is dropped; the mip levels of the planes are made for it. */
export const ALPHA_CUT = 0.1;

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
	/** Colour at the skin and at the tips; where the pelt has a colour plane only the ratio of the tips counts. */
	root?: Color;
	tip?: Color;
	/** Colour of the other tips, to which the mesh's attributes lead over. */
	tip2?: Color;
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
	'tip2',
	'rampPower',
] as const satisfies (keyof FurMaterialParameters)[];

/**
 * Shells of fur lit by polynomial texture maps (Tang, Li, Lv 2009), under three's own lights.
 *
 * Per vertex the lights are summed into a few moments; per fragment a texel's coefficients meet them in one dot
 * product. Colours are linear, blending is premultiplied, depth is written: shells have to be drawn inside-out.
 */
export class FurMaterial extends PeltMaterial {
	declare furLength: number;
	declare slabsPerShell: number;
	declare alphaCut: number;
	declare bodyRadius: number;
	declare skinColour: Color;
	declare root: Color;
	declare tip: Color;
	declare tip2: Color;
	declare rampPower: number;

	constructor(asset: FurAsset, textures: FurTextures, parameters: FurMaterialParameters = {}) {
		const pelt = asset.pelts[0];
		if (!pelt) throw new Error('FUR_ptm_shells/pelts: got none, expected at least one');
		const { basis, environment, ramp } = asset;
		super(
			{ ...pelt, basis, environment },
			textures,
			{
				name: 'FurMaterial',
				vertexShader: `${shell}\n${vertexMain}`,
				fragmentShader: `${opacity}\n${fragmentMain}`,
				uniforms: {
					tiles: { value: asset.tiles ?? 1 },
					layers: { value: asset.layers },
					furLength: { value: asset.length },
					slabsPerShell: { value: 1 },
					alphaCut: { value: ALPHA_CUT },
					bodyRadius: { value: BODY_RADIUS },
					skinColour: { value: new Color(1, 1, 1) },
					root: { value: new Color(...ramp.root) },
					tip: { value: new Color(...ramp.tip) },
					tip2: { value: new Color(...ramp.tip2) },
					rampPower: { value: ramp.power },
				},
				defines: { MAX_SLANT: '6.0' },
				depthWrite: true,
			},
			MIRRORED,
		);
		this.setValues(parameters);
	}
}
