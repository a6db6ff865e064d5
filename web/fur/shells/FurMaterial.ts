import { Color, type ShaderMaterialParameters, Vector2, Vector3, Vector4 } from 'three';
import { type Roots, rootUniforms } from '../body/roots/Roots.ts';
import { hairsOf } from '../format/hairsOf.ts';
import { type FurAsset, fursOf, type Pelt, tileOf } from '../format.ts';
import { bentWeights, leanOf, wayOf } from '../light/bent.ts';
import { eyeUniforms } from '../light/eye.ts';
import type { FurTextures, TexelCoding } from '../light/texels.ts';
import { crispLevels } from '../planes/crisp.ts';
import fragmentMain from '../shaders/draw/shells.frag.glsl?raw';
import ends from '../shaders/draw/shells.glsl?raw';
import vertexMain from '../shaders/draw/shells.vert.glsl?raw';
import frame from '../shaders/hair/frame.glsl?raw';
import hairIn from '../shaders/hair/hair.frag.glsl?raw';
import hairOut from '../shaders/hair/hair.vert.glsl?raw';
import opacity from '../shaders/hair/opacity.glsl?raw';
import shell from '../shaders/hair/shell.glsl?raw';
import drift from '../shaders/hair/tile/drift.glsl?raw';
import { ALPHA_CUT, CONTRASTS } from './lod.ts';
import { PeltMaterial } from './PeltMaterial.ts';
import { morphUniforms, weightUniforms } from './parts/morphs.ts';
import { parts } from './parts/parts.ts';

/** Properties that a FurMaterial has beside those of every material. */
export interface FurMaterialParameters extends ShaderMaterialParameters {
	/** Longest fur, the mesh's own units; see `Fur.length`. @internal */
	furLength?: number;
	/** Shells of one body; may lie between two whole numbers. */
	shellCount?: number;
	/** How far shells have gone over to those that stand for several; FurShells sets it for every picture. @internal */
	merged?: number;
	/** Which ones do, see shaders/hair/shell.glsl; FurShells sets it for every picture. @internal */
	groups?: Vector4;
	/** Coverage below which a fragment is dropped, 0..1; FurShells sets it for every picture. */
	alphaCut?: number;
	/** {@inheritDoc FurMaterial.bodyRadius} */
	bodyRadius?: number;
	/** See `setCrispness`; FurShells does for every picture. @internal */
	crispness?: Vector2;
	/** Base colour of the model, which multiplies the fur's. */
	skinColor?: Color;
	/** Linear colour at the skin. */
	root?: Color;
	/** Linear colour of the tips; where the pelt has a colour plane only the ratio of the two tips counts. */
	tip?: Color;
	/** Second tip colour, blended in by the mesh's attributes. */
	tip2?: Color;
	/** Strength of `tip2`, 0..1. */
	tipShare?: number;
	/** p in mix(root, tip, s^p), s from 0 at the skin to 1 at the tip. */
	rampPower?: number;
	/** Exponent of the highlights: 20 is matt, 200 wet. */
	sharpness?: number;
	/** {@inheritDoc FurMaterial.environment} */
	environment?: boolean;
	/** {@inheritDoc FurMaterial.gloss} */
	gloss?: number;
	/** {@inheritDoc FurMaterial.backlight} */
	backlight?: number;
	/** {@inheritDoc FurMaterial.glow} */
	glow?: number;
	/** {@inheritDoc FurMaterial.contrast} */
	contrast?: number;
	/** {@inheritDoc FurMaterial.density} */
	density?: number;
	/** {@inheritDoc FurMaterial.lampsPerFragment} */
	lampsPerFragment?: boolean;
	/** {@inheritDoc FurMaterial.multisampled} */
	multisampled?: boolean;
}

const MIRRORED = [
	'furLength',
	'shellCount',
	'merged',
	'groups',
	'alphaCut',
	'crispness',
	'skinColor',
	'root',
	'tip',
	'tip2',
	'tipShare',
	'rampPower',
	'sharpness',
] as const satisfies (keyof FurMaterialParameters)[];

/**
 * Shells of fur lit by polynomial texture maps (Tang, Li, Lv 2009), under three's own lights.
 *
 * Per vertex the lights are summed into a few moments; per fragment a texel's coefficients meet them in one dot
 * product. Colours are linear, blending is premultiplied, depth is written: shells have to be drawn inside-out.
 */
export class FurMaterial extends PeltMaterial {
	/** Longest fur, the mesh's own units; see `Fur.length`. @internal */
	declare furLength: number;
	/** {@inheritDoc FurMaterialParameters.shellCount} */
	declare shellCount: number;
	/** {@inheritDoc FurMaterialParameters.merged} @internal */
	declare merged: number;
	/** {@inheritDoc FurMaterialParameters.groups} @internal */
	declare groups: Vector4;
	/** {@inheritDoc FurMaterialParameters.alphaCut} */
	declare alphaCut: number;
	/** {@inheritDoc FurMaterialParameters.crispness} @internal */
	declare crispness: Vector2;
	/** {@inheritDoc FurMaterialParameters.skinColor} */
	declare skinColor: Color;
	/** {@inheritDoc FurMaterialParameters.root} */
	declare root: Color;
	/** {@inheritDoc FurMaterialParameters.tip} */
	declare tip: Color;
	/** {@inheritDoc FurMaterialParameters.tip2} */
	declare tip2: Color;
	/** {@inheritDoc FurMaterialParameters.tipShare} */
	declare tipShare: number;
	/** {@inheritDoc FurMaterialParameters.rampPower} */
	declare rampPower: number;
	/** {@inheritDoc FurMaterialParameters.sharpness} */
	declare sharpness: number;

	/** @param roots picture of the skin below; undefined: colours of the vertices */
	// Long: one flat table of uniforms and defaults.
	constructor(asset: FurAsset, textures: FurTextures, parameters: FurMaterialParameters = {}, roots?: Roots) {
		const pelt = asset.pelts[0];
		if (!pelt) throw new Error('FUR_ptm_shells/pelts: got none, expected at least one');
		const { ramp, regions } = asset;
		const furs = hairsOf(asset);
		super(
			furs.map(codingOf),
			textures,
			{
				name: 'FurMaterial',
				vertexShader: [frame, drift, shell, hairOut, vertexMain, ends].join('\n'),
				fragmentShader: [
					...(roots || regions ? [drift] : []),
					parts.regions?.dissolve ?? '',
					opacity,
					hairIn,
					fragmentMain,
					ends,
				].join('\n'),
				uniforms: {
					tiles: { value: asset.tiles ?? 1 },
					furLength: { value: asset.length },
					shellCount: { value: asset.layers },
					firstShell: { value: 0 },
					merged: { value: 0 },
					groups: { value: new Vector4() },
					drift: { value: furs.flatMap(({ drift }) => driftKnots(drift)) },
					spreads: { value: furs.map((fur) => spreadOf(fur, asset)) },
					shorts: { value: furs.map((fur) => shortOf(fur, asset)) },
					lean: { value: leanOf(asset) },
					bent: { value: furs.flatMap(bentWeights) },
					...eyeUniforms(furs),
					...(regions && parts.regions?.regionUniforms(regions, furs, fursOf(asset))),
					...morphUniforms(),
					...weightUniforms(),
					alphaCut: { value: ALPHA_CUT },
					crispness: { value: new Vector2(1, 0) },
					crispLevels: { value: new Uint32Array() },
					skinColor: { value: new Color(1, 1, 1) },
					root: { value: new Color(...ramp.root) },
					tip: { value: new Color(...ramp.tip) },
					tip2: { value: new Color(...ramp.tip2) },
					tipShare: { value: 1 },
					rampPower: { value: ramp.power },
					bodyLight0: { value: null },
					bodyLight1: { value: null },
					bodyLight2: { value: null },
					bodyEntries: { value: new Vector3() },
					...(roots && rootUniforms(roots, asset)),
				},
				defines: {
					MAX_SLANT: '6.0',
					HAIR: '0.2',
					LAYERS: asset.layers,
					...(regions && { REGIONS: 1 + regions.furs.length, ...(furs.length === 1 && { SAME_HAIRS: '' }) }),
					...(asset.eye && { EYE: '' }),
					...(roots && { ROOTS: '' }),
				},
				depthWrite: true,
			},
			MIRRORED,
		);
		this.setValues(parameters);
	}

	/** Replaces the planes, and the levels of crisp hairs with them. */
	override setTextures(textures: FurTextures): void {
		super.setTextures(textures);
		const { crispLevels: levels } = this.uniforms;
		if (levels) levels.value = crispLevels(textures, CONTRASTS);
	}
}

/** Coding of a fur's texels. */
function codingOf(asset: FurAsset): TexelCoding {
	const pelt = asset.pelts[0] as Pelt;
	const { basis, environment, curves, pelts } = asset;
	const means = curves && { curves, way: wayOf(asset), weights: pelt.weights ?? [], multiple: pelt.multiple };
	return { ...pelt, basis, environment, means, pelts };
}

/**
 * Spread of a fur's hairs: X = of their slopes, 0 where the asset does not tell it, in widths of its tile, Y = length of the
 * longest hairs of the body, in widths of the coat's, Z = share of the skin that is seen between them.
 */
function spreadOf({ spread = 0, height, open = 0 }: FurAsset, asset: FurAsset): Vector3 {
	return new Vector3(spread * height, asset.length / tileOf(asset), open);
}

/** Light on hairs shorter than a fur's own, see shaders/light/short.glsl. */
function shortOf({ short = [0, 0, 0], height }: FurAsset, asset: FurAsset): Vector4 {
	return new Vector4(...short, 1 / (height * tileOf(asset)));
}

/** Mean displacement of the hairs at the root and in every slab's middle, two to a vector. */
function driftKnots(drift: FurAsset['drift']): Vector4[] {
	const knots = [0, 0, ...drift.flat()];
	return Array.from({ length: (drift.length + 2) >> 1 }, (_, i) =>
		new Vector4().fromArray([...knots.slice(4 * i, 4 * i + 4), 0, 0]),
	);
}
