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
	type Object3D,
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
import type { FurMaterial } from '../shells/FurMaterial.ts';
import type { FurShells } from '../shells/FurShells.ts';
import { HullMaterial } from '../shells/HullMaterial.ts';
import { BaselineMaterial } from './BaselineMaterial.ts';
import { firstLamp } from './firstLamp.ts';
import { LightDouble } from './LightDouble.ts';
import deepOpacity from './shaders/deep/deepOpacity.glsl?raw';
import hullFragment from './shaders/deep/lightHull.frag.glsl?raw';
import hullVertex from './shaders/deep/lightHull.vert.glsl?raw';
import shellsFragment from './shaders/deep/lightShells.frag.glsl?raw';
import shellsVertex from './shaders/deep/lightShells.vert.glsl?raw';
import skinFragment from './shaders/deep/lightSkin.frag.glsl?raw';
import skinVertex from './shaders/deep/lightSkin.vert.glsl?raw';

export interface MapOptions {
	/** Renderer that draws the maps; `shadow-layers` needs it. */
	renderer?: WebGLRenderer | undefined;
	/** Lamp of the maps; the first visible directional light of the fur's scene by default. */
	light?: DirectionalLight | undefined;
	/** Texels per side of the maps. */
	size?: number;
	/** Half floats where the GPU can draw to them; false forces bytes. */
	halfFloat?: boolean;
}

/** Fur to map. */
export interface MappedFur {
	/** Shells to light. */
	readonly shells: FurShells;
	/** Body, which shades its far side. */
	readonly skin: Object3D;
}

/** Largest opacity in a byte, e-foldings; more is invisible. */
const BYTE_OPACITY = 8;
/** Uniforms that the maps depend on, beside the light's direction and the fur's transform. */
const WATCHED = ['furLength', 'furTrim', 'shellCount', 'firstShell', 'merged', 'tiles', 'density'] as const;
const TEXTURES = ['plane0', 'plane1', 'swing', 'stains'] as const;
const MOVING = ['position', '_fur', '_comb'] as const;

const AXES = ['x', 'y', 'z'] as const;
const UNIT_FROM_CLIP = new Matrix4().makeTranslation(0.5, 0.5, 0.5).scale(new Vector3(0.5, 0.5, 0.5));

/**
 * Deep opacity maps of one fur (Yuksel and Keyser 2008): depths of its outside and of the skin in one texture, then the
 * opacity of all shells in four layers below that outside. Redrawn only when light, fur or shells have changed.
 */
export class DeepOpacityMaps {
	/** Uniforms for the lookup. */
	readonly uniforms: Record<'lightDepths' | 'lightOpacity' | 'mapDepth' | 'opacityUnit', IUniform> = {
		lightDepths: { value: null },
		lightOpacity: { value: null },
		mapDepth: { value: 1 },
		opacityUnit: { value: 1 },
	};
	/** World space → XY of the maps, Z = depth in them, all 0..1. */
	readonly mapFromWorld = new Matrix4();
	readonly #fur: MappedFur;
	readonly #shells: FurMaterial;
	readonly #renderer: WebGLRenderer;
	readonly #options: MapOptions & Required<Pick<MapOptions, 'size' | 'halfFloat'>>;
	readonly #camera = new OrthographicCamera();
	readonly #depthScene = new Scene();
	readonly #opacityScene = new Scene();
	readonly #doubles: LightDouble[] = [];
	readonly #materials: ShaderMaterial[];
	#drawnTo: readonly [depths: WebGLRenderTarget, opacity: WebGLRenderTarget] | undefined;
	#depthBuffer: DepthTexture | undefined;
	/** Values of all dependencies at the last draw. */
	readonly #drawnFor: number[] = [];
	#cursor = 0;
	#differs = false;
	readonly #sphere = new Sphere();
	readonly #towards = new Vector3();
	readonly #from = new Vector3();
	readonly #clear = new Color();

	constructor(fur: MappedFur, shells: FurMaterial, { renderer, light, size = 512, halfFloat = true }: MapOptions = {}) {
		if (!renderer) throw new Error('furMethod: got shadow-layers without a renderer, expected the option renderer');
		this.#renderer = renderer;
		this.#fur = fur;
		this.#shells = shells;
		this.#options = { light, size, halfFloat };
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
		const layers = new BaselineMaterial(shells, {
			name: 'LightShells',
			vertexShader: shellsVertex,
			fragmentShader: `${deepOpacity}\n${shellsFragment}`,
			uniforms: this.uniforms,
			blendSrc: OneFactor,
			blendDst: OneFactor,
			// Independent of the picture's blending.
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
		// One hull, the outside of all shells; after the skin, which hides its far part.
		outside.renderOrder = 1;
		outside.onBeforeRender = () => {
			hull.follow();
			fur.shells.geometry.instanceCount = 1;
		};
		this.#double(fur.shells, layers, this.#opacityScene).onBeforeRender = () => {
			fur.shells.geometry.instanceCount = fur.shells.drawnShells;
		};
	}

	#double(of: Mesh, material: ShaderMaterial, scene: Scene): Mesh {
		const double = new LightDouble(of, material);
		scene.add(double);
		this.#doubles.push(double);
		return double;
	}

	/** Redraws the maps if outdated. @returns whether they were */
	update(): boolean {
		const renderer = this.#renderer;
		const light = this.#options.light ?? firstLamp(this.#fur.shells);
		if (!light || renderer.getContext().isContextLost()) return false;
		this.#aim(light);
		const [depths, opacity] = this.#targets(renderer);
		// False after a lost context.
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

	/** Move the doubles to the fur, and find the light's direction. */
	#aim(light: DirectionalLight): void {
		const { shells } = this.#fur;
		for (const bone of shells.skeleton?.bones ?? []) bone?.updateWorldMatrix(true, false);
		shells.updateWorldMatrix(true, false);
		// Its parts take their pose.
		shells.parent?.updateMatrixWorld();
		for (const double of this.#doubles) double.follow();
		light.updateWorldMatrix(true, false);
		light.target.updateWorldMatrix(true, false);
		this.#from.setFromMatrixPosition(light.target.matrixWorld);
		this.#towards.setFromMatrixPosition(light.matrixWorld).sub(this.#from).normalize();
	}

	/** Compare all dependencies with those of the last draw, and keep them. */
	#changed(): boolean {
		this.#cursor = 0;
		this.#differs = false;
		for (const axis of AXES) this.#note(this.#towards[axis]);
		for (const double of this.#doubles) double.tell(this.#note);
		for (const bone of this.#fur.shells.skeleton?.bones ?? []) bone?.matrixWorld.elements.forEach(this.#note);
		for (const name of WATCHED) this.#note(this.#shells.uniforms[name]?.value ?? 0);
		for (const name of TEXTURES) {
			const texture = this.#shells.uniforms[name]?.value;
			this.#note(texture?.id ?? -1);
			this.#note(texture?.version ?? -1);
		}
		for (const name of MOVING) this.#note(versionOf(this.#fur.shells.geometry.attributes[name]));
		return this.#differs;
	}

	readonly #note = (value: number): void => {
		this.#differs ||= this.#drawnFor[this.#cursor] !== value;
		this.#drawnFor[this.#cursor++] = value;
	};

	/** Fit the light's camera to the fur's bounding sphere. */
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
		// Any up vector not along the light.
		camera.up.set(0, 1, 0);
		if (Math.abs(this.#towards.y) > 0.9) camera.up.set(1, 0, 0);
		camera.lookAt(center);
		camera.updateProjectionMatrix();
		camera.updateMatrixWorld();
		this.mapFromWorld.copy(UNIT_FROM_CLIP).multiply(camera.projectionMatrix).multiply(camera.matrixWorldInverse);
		this.uniforms.mapDepth.value = (2 * this.#sphere.radius) / (this.#shells.furLength * scale);
	}

	/** Targets, made on first use, when the renderer is known. */
	#targets(renderer: WebGLRenderer): readonly [depths: WebGLRenderTarget, opacity: WebGLRenderTarget] {
		if (this.#drawnTo) return this.#drawnTo;
		const { extensions, capabilities } = renderer;
		const size = Math.min(this.#options.size, capabilities.maxTextureSize);
		const half =
			this.#options.halfFloat &&
			(extensions.has('EXT_color_buffer_float') || extensions.has('EXT_color_buffer_half_float'));
		const type = half ? HalfFloatType : UnsignedByteType;
		const options = { type, minFilter: LinearFilter, magFilter: LinearFilter, depthBuffer: true } as const;
		// One depth buffer for both: nothing behind the skin is lit.
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
