import { type Camera, Matrix4, type Scene, Vector2, type WebGLRenderer } from 'three';
import type { FurMaterial } from '../shells/FurMaterial.ts';
import { BaselineMaterial } from './BaselineMaterial.ts';
import type { DeepOpacityMaps } from './DeepOpacityMaps.ts';
import { type LocalLight, localLight } from './LengyelMaterial.ts';
import deepLookup from './shaders/deep/deepLookup.glsl?raw';
import deepOpacity from './shaders/deep/deepOpacity.glsl?raw';
import fragmentShader from './shaders/deep/shadowLayers.frag.glsl?raw';
import vertexShader from './shaders/deep/shadowLayers.vert.glsl?raw';

/** κ: extinction over coverage; forward-scattered light is not lost. */
const EXTINCTION = 0.2;

/**
 * Shells in the local light of Kajiya and Kay, with deep opacity maps for its transmittance to each hair. The first
 * directional light has the maps; all others are as in LengyelMaterial.
 */
export class ShadowLayersMaterial extends BaselineMaterial {
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
