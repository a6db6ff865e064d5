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
	type WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import type { Fur } from './Fur.ts';
import fragmentShader from './shaders/fade.frag.glsl?raw';
import vertexShader from './shaders/fade.vert.glsl?raw';

const size = new Vector2();

/** Shells and fins, and whether they are to be seen. */
type Parts = Map<Object3D, boolean>;

const partsOf = (furs: readonly Fur[]): Parts =>
	new Map(furs.flatMap(({ shells, fins }) => [shells, ...(fins ? [fins] : [])]).map((part) => [part, part.visible]));

/**
 * Goes over from some furs of a body to others, such as from coarse planes to fine ones, without a jump: for as long as it
 * takes the scene is drawn with the ones and with the others, and the pictures are mixed. For a renderer that blends in linear
 * light: with an `outputBufferType` and tone mapping.
 *
 *     const fine = dress(fur, pelt);
 *     fine.visible = false;
 *     await prepareFur(fine, renderer, scene, camera, new WebGLRenderTarget());
 *     fine.visible = true;
 *     const fade = new FurFade([fur], [fine]);
 *     scene.add(fade);
 *     // each frame, with a share that goes from 0 to 1
 *     fade.share = share;
 *     fade.capture(renderer, scene, camera);
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
	 * @param from furs that go; all of them are `visible`
	 * @param to furs that come, `visible` as well
	 * @param samples as many as the picture itself has per pixel
	 */
	constructor(from: readonly Fur[], to: readonly Fur[], samples = 0) {
		const material = new ShaderMaterial({
			...{ name: 'FurFade', glslVersion: GLSL3, vertexShader, fragmentShader },
			uniforms: { picture: { value: null } },
			...{ transparent: true, depthTest: false, depthWrite: false, blending: CustomBlending, blendAlpha: 1 },
			...{ blendSrc: ConstantAlphaFactor, blendDst: OneMinusConstantAlphaFactor },
		});
		super(new PlaneGeometry(2, 2), material);
		this.name = 'fade between furs';
		this.frustumCulled = false;
		// Over all that is drawn.
		this.renderOrder = Number.MAX_SAFE_INTEGER;
		this.#from = partsOf(from);
		this.#to = partsOf(to);
		this.#target = new WebGLRenderTarget(1, 1, { type: HalfFloatType, samples });
	}

	/** How much is seen of what comes, 0..1. */
	get share(): number {
		return 1 - this.material.blendAlpha;
	}

	set share(share: number) {
		this.material.blendAlpha = 1 - share;
	}

	/** To be called before every frame: draws the picture that goes, at the size of the canvas. */
	capture(renderer: WebGLRenderer, scene: Scene, camera: Camera): void {
		const { x, y } = renderer.getDrawingBufferSize(size);
		this.#target.setSize(x, y);
		const before = renderer.getRenderTarget();
		const coming = new Map([...this.#to.keys()].map((part) => [part, part.visible]));
		for (const part of this.#to.keys()) part.visible = false;
		for (const [part, seen] of this.#from) part.visible = seen;
		this.visible = false;
		renderer.setRenderTarget(this.#target);
		renderer.render(scene, camera);
		renderer.setRenderTarget(before);
		this.visible = true;
		for (const part of this.#from.keys()) part.visible = false;
		for (const [part, seen] of coming) part.visible = seen;
		this.material.uniforms.picture = { value: this.#target.texture };
	}

	/** Ends it, at whatever share: the parts of both are seen as they were. */
	override dispose(): void {
		this.removeFromParent();
		for (const [part, seen] of this.#from) part.visible = seen;
		this.#target.dispose();
		this.geometry.dispose();
		this.material.dispose();
	}
}
