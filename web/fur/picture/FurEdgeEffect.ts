import {
	CustomBlending,
	GLSL3,
	type Material,
	Mesh,
	NoBlending,
	OneFactor,
	OrthographicCamera,
	PlaneGeometry,
	ShaderMaterial,
	Vector2,
	type WebGLRenderer,
	type WebGLRenderTarget,
	ZeroFactor,
} from 'three';
import fragmentShader from '../shaders/picture/edges.frag.glsl?raw';
import vertexShader from '../shaders/picture/fade.vert.glsl?raw';

/**
 * Smooth outlines of fur and of meshes within it: an effect for a renderer with an `outputBufferType`.
 *
 *     const edges = new FurEdgeEffect();
 *     renderer.setEffects([edges]);
 *     edges.mark(eye.material);
 *
 * Fur is many layers of blended pixels: in software a multisampled target costs 1.5 to 2.3 times the frame, this pass 1.06
 * times. It filters the finished picture before tone mapping. The picture has to be opaque.
 */
export class FurEdgeEffect {
	/** Whether the effect is on. */
	enabled = true;
	readonly #camera = new OrthographicCamera();
	readonly #quad: Mesh<PlaneGeometry, ShaderMaterial>;

	constructor() {
		const material = new ShaderMaterial({
			...{ name: 'FurEdgeEffect', glslVersion: GLSL3, vertexShader, fragmentShader },
			uniforms: { picture: { value: null }, texel: { value: new Vector2() } },
			// Smallest difference between the sides of an edge: 1/16 of white, or 1/5 of the brighter side; ends are sought 12 pixels away.
			defines: { MIN_CONTRAST: '0.0625', SHARE: '0.2', STEPS: 8 },
			...{ depthTest: false, depthWrite: false, blending: NoBlending },
		});
		this.#quad = new Mesh(new PlaneGeometry(2, 2), material);
		this.#quad.frustumCulled = false;
	}

	/**
	 * Detects the outline of an opaque mesh, such as an eye in the fur, by coverage, not by brightness. Without this effect
	 * such a mesh is transparent in the picture.
	 */
	mark(material: Material): void {
		material.blending = CustomBlending;
		Object.assign(material, { blendSrc: OneFactor, blendDst: ZeroFactor });
		Object.assign(material, { blendSrcAlpha: ZeroFactor, blendDstAlpha: ZeroFactor });
	}

	/** Sets the picture's size in pixels; called by the renderer. */
	setSize(width: number, height: number): void {
		this.#quad.material.uniforms.texel?.value.set(1 / width, 1 / height);
	}

	/** Filters the picture; called by the renderer. */
	render(renderer: WebGLRenderer, to: WebGLRenderTarget, from: WebGLRenderTarget): void {
		const { picture } = this.#quad.material.uniforms;
		if (picture) picture.value = from.texture;
		renderer.setRenderTarget(to);
		renderer.render(this.#quad, this.#camera);
	}

	/** Frees its GPU objects. */
	dispose(): void {
		this.#quad.geometry.dispose();
		this.#quad.material.dispose();
	}
}
