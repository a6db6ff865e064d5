import { type Camera, Matrix4, type Scene, Vector2, type WebGLRenderer } from 'three';
import type { FurMaterial } from '../FurMaterial.ts';
import type { DeepOpacityMaps } from './DeepOpacityMaps.ts';
import deepLookup from './deepLookup.glsl?raw';
import deepOpacity from './deepOpacity.glsl?raw';
import { type LocalLight, localLight } from './LengyelMaterial.ts';
import { RivalMaterial } from './RivalMaterial.ts';
import fragmentShader from './shadowLayers.frag.glsl?raw';
import vertexShader from './shadowLayers.vert.glsl?raw';

/** κ: hairs hide that much of the light that their coverage would; what they scatter forwards is not lost. */
const EXTINCTION = 0.2;

/**
 * Shells in the local light of Kajiya and Kay, of which deep opacity maps say how much comes through to a hair. The first
 * directional light is the one with the maps; all others are lit as LengyelMaterial has it.
 */
export class ShadowLayersMaterial extends RivalMaterial {
	readonly #maps: DeepOpacityMaps;
	readonly #mapFromView = new Matrix4();

	constructor(shells: FurMaterial, maps: DeepOpacityMaps, options: LocalLight = {}) {
		const { vertex, fragment, uniforms, defines } = localLight(shells, options, {
			diffuse: 2.5,
			skyDiffuse: 2.9,
			darkness: new Vector2(0.6, 0.6),
		});
		super(shells, {
			name: 'ShadowLayersMaterial',
			lights: true,
			vertexShader: `${vertex}\n${vertexShader}`,
			fragmentShader: `${deepOpacity}\n${deepLookup}\n${fragment}\n${fragmentShader}`,
			uniforms: { ...uniforms, ...maps.uniforms, extinction: { value: EXTINCTION } },
			defines,
		});
		this.#maps = maps;
		this.uniforms.mapFromView = { value: this.#mapFromView };
	}

	override onBeforeRender(renderer: WebGLRenderer, scene: Scene, camera: Camera): void {
		super.onBeforeRender(renderer, scene, camera);
		this.#mapFromView.multiplyMatrices(this.#maps.mapFromWorld, camera.matrixWorld);
	}
}
