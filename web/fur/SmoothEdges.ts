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
import fragmentShader from './shaders/edges.frag.glsl?raw';
import vertexShader from './shaders/fade.vert.glsl?raw';

/**
 * Outlines without stair steps, of fur and of what it grows around: an effect for a renderer with an `outputBufferType`.
 *
 *     const edges = new SmoothEdges();
 *     renderer.setEffects([edges]);
 *     edges.mark(eye.material);
 *
 * Fur is many layers of blended pixels: a multisampled target makes a frame 1.5 to 2.3 times as dear where it is drawn in
 * software, this 1.06 times. It is one look at the finished picture, before it is toned. The picture has to be opaque.
 */
export class SmoothEdges {
	/** Whether it is done. */
	enabled = true;
	readonly #camera = new OrthographicCamera();
	readonly #quad: Mesh<PlaneGeometry, ShaderMaterial>;

	constructor() {
		const material = new ShaderMaterial({
			...{ name: 'SmoothEdges', glslVersion: GLSL3, vertexShader, fragmentShader },
			uniforms: { picture: { value: null }, texel: { value: new Vector2() } },
			// Sides are apart by 1/16 of white, or 1/5 of the brighter one, at least; ends are sought 12 pixels away.
			defines: { LEAST: '0.0625', SHARE: '0.2', STEPS: 8 },
			...{ depthTest: false, depthWrite: false, blending: NoBlending },
		});
		this.#quad = new Mesh(new PlaneGeometry(2, 2), material);
		this.#quad.frustumCulled = false;
	}

	/**
	 * Has the outline of an opaque mesh, such as an eye in the fur, be found by what it covers, not by how bright it is. It is
	 * transparent then in a picture without this effect.
	 */
	mark(material: Material): void {
		material.blending = CustomBlending;
		Object.assign(material, { blendSrc: OneFactor, blendDst: ZeroFactor });
		Object.assign(material, { blendSrcAlpha: ZeroFactor, blendDstAlpha: ZeroFactor });
	}

	/** Called by the renderer: size of the picture, pixels. */
	setSize(width: number, height: number): void {
		this.#quad.material.uniforms.texel?.value.set(1 / width, 1 / height);
	}

	/** Called by the renderer. */
	render(renderer: WebGLRenderer, to: WebGLRenderTarget, from: WebGLRenderTarget): void {
		const { picture } = this.#quad.material.uniforms;
		if (picture) picture.value = from.texture;
		renderer.setRenderTarget(to);
		renderer.render(this.#quad, this.#camera);
	}

	/** Frees what it has on the GPU. */
	dispose(): void {
		this.#quad.geometry.dispose();
		this.#quad.material.dispose();
	}
}
