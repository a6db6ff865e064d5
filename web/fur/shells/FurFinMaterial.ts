import { DoubleSide, type IUniform, type ShaderMaterialParameters } from 'three';
import type { Fin } from '../format.ts';
import type { FurTextures } from '../light/texels.ts';
import fragmentMain from '../shaders/draw/fins.frag.glsl?raw';
import ends from '../shaders/draw/fins.glsl?raw';
import vertexMain from '../shaders/draw/fins.vert.glsl?raw';
import drift from '../shaders/hair/tile/drift.glsl?raw';
import type { FurMaterial } from './FurMaterial.ts';
import { PeltMaterial } from './PeltMaterial.ts';
import { morphUniforms } from './parts/morphs.ts';

/** Properties that a FurFinMaterial has beside those of every material. */
export interface FurFinMaterialParameters extends ShaderMaterialParameters {
	/** Height of the fins over the fur's beside them, a factor. */
	finLength?: number;
	/** Factor of their coverage, 0..1. */
	finOpacity?: number;
	/** Factor of the second texture coordinate that makes it 1 at the tips. */
	finHeights?: number;
}

const MIRRORED = ['finLength', 'finOpacity', 'finHeights'] as const satisfies (keyof FurFinMaterialParameters)[];

/** Parts of the shells' shaders that the pelt decides on. */
const PARTS = ['LAYERS', 'EYE', 'ROOTS', 'REGIONS', 'SAME_HAIRS'];

/** Uniforms shared with the shells. */
const SHARED = [
	...[
		'tiles',
		'furLength',
		'furTrim',
		'bodyRadius',
		'shorts',
		'lean',
		'bent',
		'eye',
		'surge',
		'gloss',
		'sharpness',
		'backlight',
		'glow',
		'density',
	],
	...['swing', 'stains', 'wetnesses', 'traits', 'mud', 'morphCount', 'morphs'],
	...['skinColor', 'root', 'tip', 'tip2', 'tipShare', 'rampPower', 'roots', 'rootsUnit', 'drift'],
	...['tileWidths', 'leans', 'surges', 'regionRamps', 'regionPowers'],
];

/**
 * Fins: the fur cut from the side, on quads along the skin's edges, drawn at the silhouette.
 *
 * Lit by a polynomial texture map of their own over the light along the fur and along the normal. Colours and lengths are
 * the shells'. They write no depth: the shells are blended over them.
 */
export class FurFinMaterial extends PeltMaterial {
	/** {@inheritDoc FurFinMaterialParameters.finLength} */
	declare finLength: number;
	/** {@inheritDoc FurFinMaterialParameters.finOpacity} */
	declare finOpacity: number;
	/** {@inheritDoc FurFinMaterialParameters.finHeights} */
	declare finHeights: number;

	constructor(fin: Fin, textures: FurTextures, shells: FurMaterial, parameters: FurFinMaterialParameters = {}) {
		const shared = SHARED.filter((name) => name in shells.uniforms).map(
			(name) => [name, shells.uniforms[name]] as [string, IUniform],
		);
		const { finEye } = shells.uniforms;
		super(
			shells.furs.map(({ means, pelts }) => ({ ...(pelts?.[0]?.fin ?? fin), means, pelts })),
			textures,
			{
				name: 'FurFinMaterial',
				vertexShader: [...('ROOTS' in shells.defines ? [drift] : []), vertexMain, ends].join('\n'),
				fragmentShader: [fragmentMain, ends].join('\n'),
				uniforms: {
					...Object.fromEntries(shared),
					...(finEye && { eye: finEye }),
					...morphUniforms(),
					finLength: { value: 1 },
					finOpacity: { value: 0.9 },
					finHeights: { value: shells.uniforms.tiles?.value },
				},
				// |n·v| of the faces, between which a fin fades out.
				defines: {
					FIN: '',
					...(finEye && { FIN_EYE: '' }),
					...Object.fromEntries(Object.entries(shells.defines).filter(([part]) => PARTS.includes(part))),
					FADE_FROM: '0.03',
					FADE_TO: '0.15',
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
