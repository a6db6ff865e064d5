import {
	BufferAttribute,
	BufferGeometry,
	Camera,
	GLSL3,
	type IUniform,
	Mesh,
	NoBlending,
	RawShaderMaterial,
	Scene,
	type WebGLRenderer,
	type WebGLRenderTarget,
} from 'three';
import vertexShader from './shaders/texel.vert.glsl?raw';

/** A fragment shader for every texel of a target. */
export class TexelPass {
	readonly uniforms: Record<string, IUniform>;
	readonly #material: RawShaderMaterial;
	readonly #geometry = new BufferGeometry();
	readonly #scene = new Scene();
	readonly #camera = new Camera();

	constructor(
		name: string,
		fragmentShader: string,
		uniforms: Record<string, IUniform>,
		defines: Record<string, string | number> = {},
	) {
		this.uniforms = uniforms;
		this.#material = new RawShaderMaterial({
			name,
			glslVersion: GLSL3,
			vertexShader,
			fragmentShader,
			uniforms,
			defines,
			blending: NoBlending,
			depthTest: false,
			depthWrite: false,
		});
		// One triangle over the target, without a seam.
		this.#geometry.setAttribute('position', new BufferAttribute(Float32Array.of(-1, -1, 0, 3, -1, 0, -1, 3, 0), 3));
		const triangle = new Mesh(this.#geometry, this.#material);
		triangle.frustumCulled = false;
		for (const object of [triangle, this.#camera, this.#scene])
			object.matrixAutoUpdate = object.matrixWorldAutoUpdate = false;
		this.#scene.add(triangle);
	}

	/** Draws and restores the renderer's target, viewport and scissor. Does nothing while the context is lost. */
	draw(renderer: WebGLRenderer, target: WebGLRenderTarget): void {
		if (renderer.getContext().isContextLost()) return;
		const before = renderer.getRenderTarget();
		const face = renderer.getActiveCubeFace();
		const level = renderer.getActiveMipmapLevel();
		const { autoClear } = renderer;
		const { enabled } = renderer.xr;
		renderer.autoClear = false;
		renderer.xr.enabled = false;
		this.#material.uniformsNeedUpdate = true;
		renderer.setRenderTarget(target);
		renderer.render(this.#scene, this.#camera);
		renderer.setRenderTarget(before, face, level);
		renderer.autoClear = autoClear;
		renderer.xr.enabled = enabled;
	}

	/** Frees program and triangle. */
	dispose(): void {
		this.#material.dispose();
		this.#geometry.dispose();
	}
}
