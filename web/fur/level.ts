/** What many bodies of a fur are drawn with: one level of detail of shells and fins, and the hull that casts their shadow. */

import {
	type BufferGeometry,
	type Camera,
	Color,
	FrontSide,
	InstancedBufferAttribute,
	InstancedBufferGeometry,
	type IUniform,
	Material,
	Mesh,
	type Scene,
	ShaderMaterial,
	type Sphere,
	UniformsLib,
	UniformsUtils,
	type WebGLRenderer,
} from 'three';
import { beginClip, type Columns, endClip } from './clip.ts';
import type { Fur } from './Fur.ts';
import { followHue } from './hue.ts';
import { Places } from './places.ts';

/** The twin of a fur's material for many bodies: its uniforms are the very same but for its own and the lights. */
export class BodyMaterial extends ShaderMaterial {
	readonly #source: ShaderMaterial;
	#version = -1;

	constructor(source: ShaderMaterial, own: Record<string, IUniform> = {}) {
		super();
		this.#source = source;
		this.vertexShader = source.vertexShader;
		this.fragmentShader = source.fragmentShader;
		this.glslVersion = source.glslVersion;
		this.lights = source.lights;
		this.defaultAttributeValues = source.defaultAttributeValues;
		// The renderer writes the lights of a scene into them: the fur itself may be in another.
		const lights = source.lights ? UniformsUtils.clone(UniformsLib.lights) : {};
		const hue = source.uniforms.lampHue && { lampHue: { value: new Color(1, 1, 1) } };
		this.uniforms = { ...source.uniforms, ...lights, ...hue, ...own };
		this.follow();
	}

	/** Goes by the lamps of the scene that it is drawn in, not of the fur's. */
	override onBeforeRender(_renderer: WebGLRenderer, scene: Scene, _camera: Camera): void {
		followHue(this, scene);
	}

	/** Has the same parts compiled in, and is blended alike. */
	follow(): void {
		if (this.#version === this.#source.version) return;
		this.#version = this.#source.version;
		Material.prototype.copy.call(this, this.#source);
		const { ONE_HUE } = this.defines;
		this.defines = { ...this.#source.defines, BODIES: '' };
		if (ONE_HUE === undefined) delete this.defines.ONE_HUE;
		else this.defines.ONE_HUE = ONE_HUE;
		this.needsUpdate = true;
	}
}

/** Instances of the bodies, `each` for every one of them, of a geometry that shares the vertices of another. */
class Draw extends Mesh<InstancedBufferGeometry, ShaderMaterial> {
	/** As of the fur. */
	clip: Columns | undefined;
	readonly #places: Places;
	readonly #source: BufferGeometry;
	readonly #each: number;

	constructor(source: BufferGeometry, material: ShaderMaterial, capacity: number, each: number, bounds: Sphere) {
		const geometry = new InstancedBufferGeometry();
		geometry.setIndex(source.index);
		for (const [name, attribute] of Object.entries(source.attributes)) geometry.setAttribute(name, attribute);
		geometry.boundingSphere = bounds;
		super(geometry, material);
		this.#source = source;
		this.#places = new Places(capacity, each);
		this.#each = each;
		geometry.setAttribute('body', this.#places);
		this.frustumCulled = false;
	}

	/** Draws `count` bodies from `drawn[first]` on. */
	put(drawn: Uint32Array, first: number, count: number, matrices: Float32Array, moved: boolean): void {
		// What the vertices have been given since.
		const follicle = this.#source.getAttribute('follicle');
		if (follicle && !this.geometry.hasAttribute('follicle')) this.geometry.setAttribute('follicle', follicle);
		this.visible = count > 0;
		this.#places.put(drawn, first, 1, count, matrices, moved);
		this.geometry.instanceCount = count * this.#each;
	}

	override onBeforeRender(renderer: WebGLRenderer): void {
		beginClip(renderer, this.clip);
	}

	override onAfterRender(renderer: WebGLRenderer): void {
		endClip(renderer, this.clip);
	}

	/** Frees all but what the fur's own geometry has, too. */
	override dispose(): void {
		super.dispose();
		this.removeFromParent();
		this.geometry.setIndex(null);
		for (const name of Object.keys(this.#source.attributes)) this.geometry.deleteAttribute(name);
		this.geometry.dispose();
	}
}

/** All fins of a level's bodies in one draw, all their shells in another. */
export class BodyLevel {
	/** Body-major: all shells of the farthest body, from the innermost, then those of the next. */
	readonly shells: Draw;
	readonly fins: Draw | undefined;
	readonly #fur: Fur;
	readonly #material: BodyMaterial;
	/** Of each body, in the order of the draw: shells, and coverage below which a fragment is dropped. */
	readonly #details: InstancedBufferAttribute;

	/**
	 * @param most shells of a body
	 * @param capacity most bodies that there can be
	 * @param finMaterial the caller's
	 * @param bounds of all bodies
	 */
	constructor(fur: Fur, most: number, capacity: number, finMaterial: BodyMaterial | undefined, bounds: Sphere) {
		const { shells, fins } = fur;
		this.#fur = fur;
		// What is equally far is drawn by age: fins are made before their shells.
		this.fins = fins && finMaterial && new Draw(fins.geometry, finMaterial, capacity, 1, bounds);
		this.#material = new BodyMaterial(shells.material, { shellCount: { value: most } });
		this.shells = new Draw(shells.geometry, this.#material, capacity, most, bounds);
		this.#details = new InstancedBufferAttribute(new Float32Array(2 * capacity), 2, false, most);
		this.shells.geometry.setAttribute('bodyDetail', this.#details);
		this.shells.name = `fur, up to ${most} shells`;
		if (this.fins) this.fins.name = `fins of fur, up to ${most} shells`;
	}

	/**
	 * Draws `count` bodies from `drawn[first]` on.
	 *
	 * @param matrices of all bodies
	 * @param details shells and cut of all bodies
	 * @param moved whether the matrices are others than before
	 */
	put(
		drawn: Uint32Array,
		first: number,
		count: number,
		matrices: Float32Array,
		details: Float32Array,
		moved: boolean,
	): void {
		const fur = this.#fur;
		this.#material.follow();
		this.shells.receiveShadow = fur.shells.receiveShadow;
		this.shells.clip = fur.clip;
		this.shells.put(drawn, first, count, matrices, moved);
		const { array } = this.#details;
		for (let i = 0; i < 2 * count; i++) {
			const detail = details[2 * (drawn[first + (i >> 1)] as number) + (i & 1)] as number;
			if (array[i] === detail) continue;
			array[i] = detail;
			this.#details.needsUpdate = true;
		}
		if (!this.fins || !fur.fins) return;
		this.fins.receiveShadow = fur.fins.receiveShadow;
		this.fins.clip = fur.clip;
		this.fins.put(drawn, first, fur.fins.visible ? count : 0, matrices, moved);
	}

	/** Frees all but what is the fur's. */
	dispose(): void {
		this.shells.dispose();
		this.fins?.dispose();
		this.#material.dispose();
	}
}

/** Casts the shadow of all bodies, seen or not; the picture itself has nothing of it. */
export class BodyHull extends Draw {
	override readonly customDepthMaterial: BodyMaterial;
	readonly #fur: Fur;
	readonly #all: Uint32Array;
	#count = 0;

	/** @param material any that is in use already: nothing is drawn with it */
	constructor(fur: Fur, material: ShaderMaterial, capacity: number, bounds: Sphere) {
		super(fur.shells.geometry, material, capacity, 1, bounds);
		this.#fur = fur;
		this.customDepthMaterial = new BodyMaterial(fur.shells.customDepthMaterial);
		this.#all = Uint32Array.from({ length: capacity }, (_, i) => i);
		this.name = 'hull';
	}

	putAll(count: number, matrices: Float32Array, moved: boolean): void {
		const { castShadow, customDepthMaterial } = this.#fur.shells;
		customDepthMaterial.follow();
		this.customDepthMaterial.follow();
		this.castShadow = castShadow;
		this.put(this.#all, 0, count, matrices, moved);
		this.#count = count;
		this.geometry.instanceCount = 0;
	}

	override onBeforeShadow(): void {
		this.customDepthMaterial.side = FrontSide;
		this.geometry.instanceCount = this.#count;
	}

	override onAfterShadow(): void {
		this.geometry.instanceCount = 0;
	}

	override dispose(): void {
		super.dispose();
		this.customDepthMaterial.dispose();
	}
}
