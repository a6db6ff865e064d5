import {
	type Camera,
	ConstantAlphaFactor,
	CustomBlending,
	GLSL3,
	HalfFloatType,
	Mesh,
	type Object3D,
	OneMinusConstantAlphaFactor,
	PlaneGeometry,
	type Scene,
	ShaderMaterial,
	Vector2,
	Vector4,
	type WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import type { Fur } from '../Fur.ts';
import fragmentShader from '../shaders/picture/fade.frag.glsl?raw';
import vertexShader from '../shaders/picture/fade.vert.glsl?raw';

const size = new Vector2();
const viewport = new Vector4();

/** Shells and fins, with their own visibility. */
type Parts = Map<Object3D, boolean>;

const partsOf = (furs: readonly Fur[]): Parts =>
	new Map(furs.flatMap(({ shells, fins }) => [shells, ...(fins ? [fins] : [])]).map((part) => [part, part.visible]));

/**
 * Cross-fade from some furs of a body to others, such as from coarse planes to fine ones. During the fade the scene is drawn
 * with either, and the pictures are mixed: the fade, once it is in the scene, draws the furs that go. For a renderer that
 * blends in linear light: with an `outputBufferType` and tone mapping.
 *
 *     const fine = dressFur(fur, pelt);
 *     fine.visible = false;
 *     await prepareFur(fine, renderer, scene, camera, new WebGLRenderTarget());
 *     fine.visible = true;
 *     const fade = new FurFade([fur], [fine]);
 *     scene.add(fade);
 *     // each frame, with a share that goes from 0 to 1
 *     fade.share = share;
 *     renderer.render(scene, camera);
 *     // at last
 *     fade.dispose();
 *     fur.visible = false;
 */
export class FurFade extends Mesh<PlaneGeometry, ShaderMaterial> {
	readonly #from: Parts;
	readonly #to: Parts;
	readonly #target: WebGLRenderTarget;

	/**
	 * @param from furs that fade out; all of them `visible`
	 * @param to furs that fade in, also `visible`
	 * @param samples samples per pixel of the picture
	 */
	constructor(from: readonly Fur[], to: readonly Fur[], samples = 0) {
		const material = new ShaderMaterial({
			...{ name: 'FurFade', glslVersion: GLSL3, vertexShader, fragmentShader },
			...{ transparent: true, depthTest: false, depthWrite: false, blending: CustomBlending, blendAlpha: 1 },
			...{ blendSrc: ConstantAlphaFactor, blendDst: OneMinusConstantAlphaFactor },
		});
		super(new PlaneGeometry(2, 2), material);
		this.name = 'fade between furs';
		this.frustumCulled = false;
		// Over everything else.
		this.renderOrder = Number.MAX_SAFE_INTEGER;
		this.#from = partsOf(from);
		for (const part of this.#from.keys()) part.visible = false;
		this.#to = partsOf(to);
		this.#target = new WebGLRenderTarget(1, 1, { type: HalfFloatType, samples });
		material.uniforms.picture = { value: this.#target.texture };
	}

	/** Share of the furs that fade in, 0..1. */
	get share(): number {
		return 1 - this.material.blendAlpha;
	}

	set share(share: number) {
		this.material.blendAlpha = 1 - share;
	}

	/** Draws the picture that fades out, at the size of the canvas. */
	override onBeforeRender(renderer: WebGLRenderer, scene: Scene, camera: Camera): void {
		const { x, y } = renderer.getDrawingBufferSize(size);
		this.#target.setSize(x, y);
		const before = renderer.getRenderTarget();
		const face = renderer.getActiveCubeFace();
		const level = renderer.getActiveMipmapLevel();
		renderer.getCurrentViewport(viewport);
		const coming = new Map([...this.#to.keys()].map((part) => [part, part.visible]));
		for (const part of this.#to.keys()) part.visible = false;
		for (const [part, seen] of this.#from) part.visible = seen;
		this.visible = false;
		renderer.setRenderTarget(this.#target);
		renderer.render(scene, camera);
		renderer.setRenderTarget(before, face, level);
		renderer.state.viewport(viewport);
		this.visible = true;
		for (const part of this.#from.keys()) part.visible = false;
		for (const [part, seen] of coming) part.visible = seen;
	}

	/** Ends the fade at any share and restores the visibility of all parts. */
	override dispose(): void {
		this.removeFromParent();
		for (const [part, seen] of this.#from) part.visible = seen;
		this.#target.dispose();
		this.geometry.dispose();
		this.material.dispose();
	}
}
