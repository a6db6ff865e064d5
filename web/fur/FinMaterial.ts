import { DoubleSide, type IUniform, type ShaderMaterialParameters } from 'three';
import type { FurMaterial } from './FurMaterial.ts';
import type { Fin } from './format.ts';
import { PeltMaterial } from './PeltMaterial.ts';
import fragmentMain from './shaders/fins.frag.glsl?raw';
import ends from './shaders/fins.glsl?raw';
import vertexMain from './shaders/fins.vert.glsl?raw';
import type { FurTextures } from './texels.ts';

/** Properties that a FinMaterial has beside those of every material. */
export interface FinMaterialParameters extends ShaderMaterialParameters {
	/** Length of the fins in lengths of the fur beside them: hairs that stand out make the outline. */
	finLength?: number;
	/** What their coverage is multiplied by, 0..1. */
	finOpacity?: number;
	/** What the second texture coordinate is multiplied by to be 1 at the tips. */
	finHeights?: number;
}

const MIRRORED = ['finLength', 'finOpacity', 'finHeights'] as const satisfies (keyof FinMaterialParameters)[];

/** What fins have from the shells that they stand between. */
const SHARED = [
	...[
		'tiles',
		'furLength',
		'furTrim',
		'bodyRadius',
		'lean',
		'bent',
		'eye',
		'surge',
		'gloss',
		'sharpness',
		'backlight',
		'density',
	],
	...['swing', 'stains', 'wetnesses', 'traits', 'mud'],
	...['skinColour', 'root', 'tip', 'tip2', 'tipShare', 'rampPower'],
];

/**
 * Fins: the fur cut from the side, on quads that stand on the skin's edges, drawn where they make the outline.
 *
 * Lit as the shells are, by a polynomial texture map of their own over the light along the edge and along the normal.
 * Colours and lengths are the shells'. They write no depth: the shells are blended over them.
 */
export class FinMaterial extends PeltMaterial {
	/** {@inheritDoc FinMaterialParameters.finLength} */
	declare finLength: number;
	/** {@inheritDoc FinMaterialParameters.finOpacity} */
	declare finOpacity: number;
	/** {@inheritDoc FinMaterialParameters.finHeights} */
	declare finHeights: number;

	constructor(fin: Fin, textures: FurTextures, shells: FurMaterial, parameters: FinMaterialParameters = {}) {
		const shared = SHARED.filter((name) => name in shells.uniforms).map(
			(name) => [name, shells.uniforms[name]] as [string, IUniform],
		);
		super(
			{ ...fin, means: shells.means },
			textures,
			{
				name: 'FinMaterial',
				vertexShader: [vertexMain, ends].join('\n'),
				fragmentShader: [fragmentMain, ends].join('\n'),
				uniforms: {
					...Object.fromEntries(shared),
					finLength: { value: 1.05 },
					finOpacity: { value: 0.9 },
					finHeights: { value: shells.uniforms.tiles?.value },
				},
				// |n·v| of the faces, between which a fin fades out; half a mip level finer than even, since fins are seen askew.
				defines: {
					FIN: '',
					LAYERS: shells.defines.LAYERS,
					...('EYE' in shells.defines && { EYE: '' }),
					FADE_FROM: '0.03',
					FADE_TO: '0.15',
					LOD_BIAS: '-0.5',
				},
				depthWrite: false,
				side: DoubleSide,
			},
			MIRRORED,
			shells,
		);
		this.setValues(parameters);
	}
}
