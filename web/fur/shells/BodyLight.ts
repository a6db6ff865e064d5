import {
	type BufferAttribute,
	type Camera,
	GLSL3,
	InstancedBufferGeometry,
	type IUniform,
	type Light,
	type Material,
	type Matrix4,
	type Mesh,
	NearestFilter,
	NoBlending,
	type NormalBufferAttributes,
	type Object3D,
	Points,
	RGBAIntegerFormat,
	type Scene,
	ShaderMaterial,
	type Skeleton,
	UniformsLib,
	UniformsUtils,
	UnsignedIntType,
	Vector2,
	type Vector3,
	Vector4,
	type WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import type { FurPose, Jointed } from '../body/FurPose.ts';
import fragmentShader from '../shaders/draw/bodyLight.frag.glsl?raw';
import bodyLight from '../shaders/draw/bodyLight.glsl?raw';
import vertexMain from '../shaders/draw/bodyLight.vert.glsl?raw';
import curvature from '../shaders/draw/curvature.glsl?raw';
import frame from '../shaders/hair/frame.glsl?raw';
import { followEnvironmentMap } from './environmentMap.ts';
import type { FurMaterial } from './FurMaterial.ts';
import { arrivalChunks, hairChunks, skyChunks } from './parts/chunks.ts';
import { followComb, followParts, switchPart } from './switches.ts';

/** Vertices in a row of texels. */
const VERTICES_PER_ROW = 1024;

/** Heights, root to tip, at which the sky's light is stored, each in the middle of a slab; linear between them. */
const SKY_HEIGHTS = 5;

/** Parts of the shells' shaders that place and bend hairs and light them by the sky. */
const PARTS = ['SWING', 'STRAIGHT', 'TRIMMED', 'WET', 'SKY', 'ENVIRONMENT_MAP', 'MORPHS'];

/** Parts of the shells' shaders that belong to the pelt. */
const PELT_PARTS = [
	'LAYERS',
	'EYE',
	'TWO_PLANES',
	'CURVES',
	'CURVES_LOW',
	'CURVES_HIGH',
	'REGIONS',
	'SAME_HAIRS',
	'ONE_FUR',
];

/** Shells that look the light up. */
type Shells = Mesh<InstancedBufferGeometry, FurMaterial>;

const viewport = new Vector4();
let lamps = 0;
const count = (object: Object3D): void => {
	if ((object as Light & { isDirectionalLight?: boolean }).isDirectionalLight) lamps++;
};

/**
 * Light at every vertex of a body: arrival of directional lamps (direction in the tangent frame, mean curves, factor of light
 * and eye), and moments of the sky at a few heights. Computed once per vertex before the shells, which look it up, not once
 * per shell. Drawn as points, one per vertex and lamp or height, into textures of integers, which every GPU can draw, unlike
 * floats. Format 2.x.
 */
export class BodyLight extends Points<InstancedBufferGeometry, ShaderMaterial> implements Jointed {
	/** Joints of the body, as on three's SkinnedMesh; those of the skin. */
	declare isSkinnedMesh?: true;
	declare skeleton?: Skeleton;
	declare bindMatrix?: Matrix4;
	declare bindMatrixInverse?: Matrix4;
	declare bind?: Jointed['bind'];
	readonly #pose: FurPose | undefined;
	readonly #shells: Shells;
	readonly #source: FurMaterial;
	readonly #target: WebGLRenderTarget;
	/** Target of the picture. */
	#outer: WebGLRenderTarget | null = null;
	#face = 0;
	#level = 0;
	/** Picture and camera of the last draw. */
	#frame = -1;
	#camera: Camera | undefined;
	#renderer: WebGLRenderer | undefined;
	/** Free objects of a lost context while it is lost: later three would ask the next context to delete them. */
	readonly #lose = (): void => {
		this.#target.dispose();
		this.#share({});
		this.geometry.dispose();
	};

	/** @param pose of the body, if it has any */
	constructor(shells: Shells, pose?: FurPose) {
		const source = shells.material;
		const { count: vertices = 0 } = shells.geometry.getAttribute('position') ?? {};
		const rows = Math.max(Math.ceil(vertices / VERTICES_PER_ROW), 1);
		super(
			new InstancedBufferGeometry(),
			new ShaderMaterial({
				name: 'BodyLight',
				glslVersion: GLSL3,
				lights: true,
				uniforms: {
					...source.uniforms,
					...UniformsUtils.clone(UniformsLib.lights),
					texels: { value: new Vector2(VERTICES_PER_ROW, rows) },
				},
				defines: { MEAN_CURVES: '' },
				vertexShader: [
					...hairChunks(),
					bodyLight,
					...arrivalChunks(true),
					...skyChunks(true),
					frame,
					curvature,
					vertexMain,
				].join('\n'),
				fragmentShader,
				blending: NoBlending,
				depthTest: false,
				depthWrite: false,
			}),
		);
		followParts(this.material, source, PELT_PARTS);
		this.name = 'light on the body';
		this.#shells = shells;
		this.#source = source;
		this.#target = new WebGLRenderTarget(VERTICES_PER_ROW, rows, {
			count: 3,
			format: RGBAIntegerFormat,
			type: UnsignedIntType,
			internalFormat: 'RGBA32UI',
			depthBuffer: false,
			magFilter: NearestFilter,
			minFilter: NearestFilter,
		});
		Object.assign(this.material.defaultAttributeValues, source.defaultAttributeValues);
		for (const [i, texture] of this.#target.textures.entries())
			(source.uniforms[`bodyLight${i}`] as IUniform).value = texture;
		(source.uniforms.bodyEntries as IUniform<Vector3>).value.set(VERTICES_PER_ROW, rows, SKY_HEIGHTS);
		this.geometry.boundingSphere = shells.geometry.boundingSphere;
		this.geometry.setDrawRange(0, vertices);
		// Before all blending: a change of target costs most in the middle of it.
		this.renderOrder = -Number.MAX_SAFE_INTEGER;
		switchPart(source, 'BODY_LIGHT', '');
		this.#pose = pose;
		pose?.carry(this);
	}

	override updateMatrixWorld(force?: boolean): void {
		super.updateMatrixWorld(force);
		this.#pose?.follow(this);
	}

	/** Ignored by ray casting. */
	override raycast(): void {}

	override onBeforeRender(
		renderer: WebGLRenderer,
		scene: Scene,
		camera: Camera,
		_geometry: unknown,
		material: Material,
	): void {
		this.#frame = -1;
		this.geometry.instanceCount = 0;
		const own = material === this.material && this.#shells.material === this.#source;
		const entries = own ? this.#fit(renderer, scene) : 0;
		if (entries === 0) return;
		followEnvironmentMap(this.#source, renderer, scene);
		this.follow();
		this.#frame = renderer.info.render.frame;
		this.#camera = camera;
		this.geometry.instanceCount = entries;
		this.#outer = renderer.getRenderTarget();
		this.#face = renderer.getActiveCubeFace();
		this.#level = renderer.getActiveMipmapLevel();
		renderer.getCurrentViewport(viewport);
		renderer.setRenderTarget(this.#target);
	}

	override onAfterRender(renderer: WebGLRenderer): void {
		if (this.#frame < 0) return;
		renderer.setRenderTarget(this.#outer, this.#face, this.#level);
		renderer.state.viewport(viewport);
	}

	/** Use the shells' present vertices, and compile in what they have. */
	follow(): void {
		this.#share(this.#shells.geometry.attributes);
		followComb(this.#shells);
		followParts(this.material, this.#source, PARTS);
	}

	/** Let the shells look it up if it has been drawn for this picture and camera. */
	offer(renderer: WebGLRenderer, camera: Camera): void {
		const drawn = this.#frame === renderer.info.render.frame && this.#camera === camera;
		if (this.#shells.material === this.#source) switchPart(this.#source, 'BODY_LIGHT', drawn ? '' : undefined);
	}

	#share(attributes: NormalBufferAttributes): void {
		const own = this.geometry.attributes;
		for (const name in attributes) if (own[name] !== attributes[name]) own[name] = attributes[name] as BufferAttribute;
		for (const name in own) if (!(name in attributes)) delete own[name];
	}

	/** Allocates textures for all lamps and the sky. @returns number of entries; 0 if there is no light, or no room */
	#fit(renderer: WebGLRenderer, scene: Scene): number {
		lamps = 0;
		scene.traverseVisible(count);
		const entries = lamps + (this.#source.environment ? SKY_HEIGHTS : 0);
		const rows = entries * (this.#source.uniforms.bodyEntries as IUniform<Vector3>).value.y;
		if (rows === 0 || rows > renderer.capabilities.maxTextureSize) return 0;
		this.#target.setSize(VERTICES_PER_ROW, rows);
		(this.material.uniforms.texels as IUniform<Vector2>).value.y = rows;
		if (this.#renderer !== renderer) {
			this.#renderer?.domElement.removeEventListener('webglcontextlost', this.#lose);
			renderer.domElement.addEventListener('webglcontextlost', this.#lose);
			this.#renderer = renderer;
		}
		return entries;
	}

	/** Frees textures and programs; the vertices are the shells'. */
	override dispose(): void {
		super.dispose();
		this.#renderer?.domElement.removeEventListener('webglcontextlost', this.#lose);
		this.#target.dispose();
		this.material.dispose();
		this.#share({});
		this.geometry.dispose();
	}
}
