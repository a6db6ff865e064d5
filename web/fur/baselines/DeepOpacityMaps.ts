import {
	type BufferAttribute,
	Color,
	CustomBlending,
	DepthTexture,
	type DirectionalLight,
	DoubleSide,
	GLSL3,
	HalfFloatType,
	type InterleavedBufferAttribute,
	type IUniform,
	LinearFilter,
	Matrix4,
	Mesh,
	MinEquation,
	OneFactor,
	OrthographicCamera,
	RGBAFormat,
	RGFormat,
	Scene,
	ShaderMaterial,
	Sphere,
	UnsignedByteType,
	Vector3,
	type WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import type { Fur } from '../Fur.ts';
import type { FurMaterial } from '../FurMaterial.ts';
import { HullMaterial } from '../HullMaterial.ts';
import deepOpacity from './deepOpacity.glsl?raw';
import hullFragment from './lightHull.frag.glsl?raw';
import hullVertex from './lightHull.vert.glsl?raw';
import shellsFragment from './lightShells.frag.glsl?raw';
import shellsVertex from './lightShells.vert.glsl?raw';
import skinFragment from './lightSkin.frag.glsl?raw';
import skinVertex from './lightSkin.vert.glsl?raw';
import { RivalMaterial } from './RivalMaterial.ts';

export interface MapOptions {
	/** Texels per side of the light's maps. */
	size?: number;
	/** false: bytes even where half floats can be drawn to. */
	halfFloat?: boolean;
}

/** What a byte has to hold of opacity; more than this many e-foldings no one sees. */
const BYTE_OPACITY = 8;

/** What the maps depend on, beside the light's direction and the fur's transform: uniforms, textures, attributes. */
const WATCHED = ['furLength', 'furTrim', 'shellCount', 'firstShell', 'tiles', 'density'] as const;
const TEXTURES = ['plane0', 'plane1', 'swing', 'stains'] as const;
const MOVING = ['position', '_fur', '_comb'] as const;

const AXES = ['x', 'y', 'z'] as const;
const UNIT_FROM_CLIP = new Matrix4().makeTranslation(0.5, 0.5, 0.5).scale(new Vector3(0.5, 0.5, 0.5));

/**
 * The light's view of one fur: depths of its outside and of the skin in one texture, then the opacity of all shells in four
 * layers below that outside (Yuksel and Keyser 2008). Drawn anew when light, fur or its shells have changed, else kept.
 */
export class DeepOpacityMaps {
	/** Of those that look something up. */
	readonly uniforms: Record<'lightDepths' | 'lightOpacity' | 'mapDepth' | 'opacityUnit', IUniform> = {
		lightDepths: { value: null },
		lightOpacity: { value: null },
		mapDepth: { value: 1 },
		opacityUnit: { value: 1 },
	};
	/** World space → XY of the maps, Z = depth in them, all 0..1. */
	readonly mapFromWorld = new Matrix4();
	readonly #fur: Pick<Fur, 'shells' | 'skin'>;
	readonly #shells: FurMaterial;
	readonly #options: Required<MapOptions>;
	readonly #camera = new OrthographicCamera();
	readonly #depthScene = new Scene();
	readonly #opacityScene = new Scene();
	/** What is drawn for the light, and what it stands for. */
	readonly #doubles: { double: Mesh; of: Mesh }[] = [];
	readonly #materials: ShaderMaterial[];
	#drawnTo: readonly [depths: WebGLRenderTarget, opacity: WebGLRenderTarget] | undefined;
	#depthBuffer: DepthTexture | undefined;
	/** What the maps depend on, as it was when they were drawn. */
	readonly #drawnFor: number[] = [];
	#cursor = 0;
	#differs = false;
	readonly #sphere = new Sphere();
	readonly #towards = new Vector3();
	readonly #from = new Vector3();
	readonly #clear = new Color();

	constructor(
		fur: Pick<Fur, 'shells' | 'skin'>,
		shells: FurMaterial,
		{ size = 512, halfFloat = true }: MapOptions = {},
	) {
		this.#fur = fur;
		this.#shells = shells;
		this.#options = { size, halfFloat };
		const nearest = {
			blending: CustomBlending,
			blendEquation: MinEquation,
			blendSrc: OneFactor,
			blendDst: OneFactor,
		} as const;
		const skin = new ShaderMaterial({
			...nearest,
			glslVersion: GLSL3,
			name: 'LightSkin',
			vertexShader: skinVertex,
			fragmentShader: skinFragment,
			side: DoubleSide,
		});
		const hull = new HullMaterial(shells, {
			...nearest,
			name: 'LightHull',
			vertexShader: hullVertex,
			fragmentShader: hullFragment,
			depthWrite: false,
		});
		const layers = new RivalMaterial(shells, {
			name: 'LightShells',
			vertexShader: shellsVertex,
			fragmentShader: `${deepOpacity}\n${shellsFragment}`,
			uniforms: this.uniforms,
			blendSrc: OneFactor,
			blendDst: OneFactor,
			// Whatever the shells of the picture do.
			blendSrcAlpha: null,
			blendDstAlpha: null,
			alphaToCoverage: false,
			depthWrite: false,
			side: DoubleSide,
		});
		this.#materials = [skin, hull, layers];
		fur.skin.traverse((piece) => {
			if (piece instanceof Mesh) this.#double(piece, skin, this.#depthScene);
		});
		const outside = this.#double(fur.shells, hull, this.#depthScene);
		// One hull, the outside of all shells; after the skin, behind which nothing of it is wanted.
		outside.renderOrder = 1;
		outside.onBeforeRender = () => {
			hull.follow();
			fur.shells.geometry.instanceCount = 1;
		};
		this.#double(fur.shells, layers, this.#opacityScene).onBeforeRender = () => {
			fur.shells.geometry.instanceCount = Math.ceil(shells.shellCount);
		};
	}

	#double(of: Mesh, material: ShaderMaterial, scene: Scene): Mesh {
		const double = new Mesh(of.geometry, material);
		double.frustumCulled = false;
		double.matrixAutoUpdate = double.matrixWorldAutoUpdate = false;
		scene.add(double);
		this.#doubles.push({ double, of });
		return double;
	}

	/** @returns whether something had changed and the maps were drawn */
	update(renderer: WebGLRenderer, light: DirectionalLight): boolean {
		this.#aim(light);
		const [depths, opacity] = this.#targets(renderer);
		// They are gone with a lost context.
		const kept = renderer.properties.has(opacity.texture);
		if (!this.#changed() && kept) return false;
		this.#fit();
		const target = renderer.getRenderTarget();
		const { autoClear } = renderer;
		const alpha = renderer.getClearAlpha();
		renderer.getClearColor(this.#clear);
		renderer.autoClear = false;
		renderer.setRenderTarget(depths);
		renderer.setClearColor(0xffffff, 1);
		renderer.clear(true, true, false);
		renderer.render(this.#depthScene, this.#camera);
		renderer.setRenderTarget(opacity);
		renderer.setClearColor(0, 0);
		renderer.clear(true, false, false);
		renderer.render(this.#opacityScene, this.#camera);
		renderer.setRenderTarget(target);
		renderer.setClearColor(this.#clear, alpha);
		renderer.autoClear = autoClear;
		return true;
	}

	/** Brings the doubles where the fur is, and finds where the light comes from. */
	#aim(light: DirectionalLight): void {
		for (const { double, of } of this.#doubles) {
			of.updateWorldMatrix(true, false);
			double.matrixWorld.copy(of.matrixWorld);
		}
		light.updateWorldMatrix(true, false);
		light.target.updateWorldMatrix(true, false);
		this.#from.setFromMatrixPosition(light.target.matrixWorld);
		this.#towards.setFromMatrixPosition(light.matrixWorld).sub(this.#from).normalize();
	}

	/** Compares all that the maps depend on with what they were drawn for, and keeps it. */
	#changed(): boolean {
		this.#cursor = 0;
		this.#differs = false;
		for (const axis of AXES) this.#note(this.#towards[axis]);
		for (const { double } of this.#doubles) for (const element of double.matrixWorld.elements) this.#note(element);
		for (const name of WATCHED) this.#note(this.#shells.uniforms[name]?.value ?? 0);
		for (const name of TEXTURES) {
			const texture = this.#shells.uniforms[name]?.value;
			this.#note(texture?.id ?? -1);
			this.#note(texture?.version ?? -1);
		}
		for (const name of MOVING) this.#note(versionOf(this.#fur.shells.geometry.attributes[name]));
		return this.#differs;
	}

	#note(value: number): void {
		this.#differs ||= this.#drawnFor[this.#cursor] !== value;
		this.#drawnFor[this.#cursor++] = value;
	}

	/** Puts the light's camera around the fur as tightly as a sphere allows. */
	#fit(): void {
		const { shells } = this.#fur;
		const { center, radius } = this.#sphere.copy(shells.geometry.boundingSphere ?? this.#sphere.makeEmpty());
		this.#sphere.applyMatrix4(shells.matrixWorld);
		const scale = this.#sphere.radius / radius;
		const camera = this.#camera;
		camera.left = camera.bottom = -this.#sphere.radius;
		camera.right = camera.top = this.#sphere.radius;
		camera.near = this.#sphere.radius;
		camera.far = 3 * this.#sphere.radius;
		camera.position.copy(center).addScaledVector(this.#towards, 2 * this.#sphere.radius);
		// Any upright will do that the light does not come along.
		camera.up.set(0, 1, 0);
		if (Math.abs(this.#towards.y) > 0.9) camera.up.set(1, 0, 0);
		camera.lookAt(center);
		camera.updateProjectionMatrix();
		camera.updateMatrixWorld();
		this.mapFromWorld.copy(UNIT_FROM_CLIP).multiply(camera.projectionMatrix).multiply(camera.matrixWorldInverse);
		this.uniforms.mapDepth.value = (2 * this.#sphere.radius) / (this.#shells.furLength * scale);
	}

	/** What is drawn to, made when it is wanted first: only then is the renderer known. */
	#targets(renderer: WebGLRenderer): readonly [depths: WebGLRenderTarget, opacity: WebGLRenderTarget] {
		if (this.#drawnTo) return this.#drawnTo;
		const { extensions, capabilities } = renderer;
		const size = Math.min(this.#options.size, capabilities.maxTextureSize);
		const half =
			this.#options.halfFloat &&
			(extensions.has('EXT_color_buffer_float') || extensions.has('EXT_color_buffer_half_float'));
		const type = half ? HalfFloatType : UnsignedByteType;
		const options = { type, minFilter: LinearFilter, magFilter: LinearFilter, depthBuffer: true } as const;
		// One depth buffer for both: what is behind the skin is in no light.
		this.#depthBuffer = new DepthTexture(size, size);
		const depths = new WebGLRenderTarget(size, size, {
			...options,
			format: RGFormat,
			depthTexture: this.#depthBuffer,
		});
		const opacity = new WebGLRenderTarget(size, size, {
			...options,
			format: RGBAFormat,
			depthTexture: this.#depthBuffer,
		});
		this.#drawnTo = [depths, opacity];
		this.uniforms.lightDepths.value = depths.texture;
		this.uniforms.lightOpacity.value = opacity.texture;
		this.uniforms.opacityUnit.value = half ? 1 : BYTE_OPACITY;
		return this.#drawnTo;
	}

	/** Frees maps and materials; geometry belongs to the fur. */
	dispose(): void {
		for (const target of this.#drawnTo ?? []) target.dispose();
		this.#depthBuffer?.dispose();
		this.#drawnTo = undefined;
		this.#drawnFor.length = 0;
		for (const material of this.#materials) material.dispose();
	}
}

function versionOf(attribute: BufferAttribute | InterleavedBufferAttribute | undefined): number {
	if (!attribute) return -1;
	return 'data' in attribute ? attribute.data.version : attribute.version;
}
