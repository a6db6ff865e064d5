/** Draws of many bodies of a fur: shells and fins of one level of detail, and the hull that casts their shadow. */

import {
	type BufferGeometry,
	type Camera,
	Color,
	FrontSide,
	InstancedBufferAttribute,
	InstancedBufferGeometry,
	type IUniform,
	Material,
	type Matrix4,
	Mesh,
	type Scene,
	ShaderMaterial,
	type Sphere,
	UniformsLib,
	UniformsUtils,
	type WebGLRenderer,
} from 'three';
import type { Fur } from '../Fur.ts';
import { beginClip, endClip, type FurColumns } from '../shells/clip.ts';
import { followEnvironmentMap } from '../shells/environmentMap.ts';
import { followHue } from '../shells/hue.ts';
import { SPACING } from '../shells/lod.ts';
import { parts } from '../shells/parts/parts.ts';
import { inOrder } from '../shells/switches.ts';
import type { BodyDetails } from './BodyDetails.ts';
import type { FarSurface, FurSimplifier } from './FarSurface.ts';
import { farFins } from './farFins.ts';
import type { HerdPoses } from './HerdPoses.ts';
import { Places } from './Places.ts';

/** Shells per body up to which a level's bodies are far away: hairs of 18 pixels. */
const FAR = 12;
/** Shells for which a far body's fins have a strip, from root to tip. */
const SHELLS_A_STRIP = 4;
/** Pixels by which the surfaces of far bodies may move where they are simplified. */
const MOVED = 1;

/** How far the surface of a body of that many shells may move, the shells' own units. */
const moveOf = ({ shells }: Fur, most: number): number => (MOVED * shells.material.furLength) / (SPACING * most);

/** Copy of a fur's material for many bodies; shares all uniforms but the lights and its own. */
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
		// The renderer writes a scene's lights into them, and the fur itself may be in another scene.
		const lights = source.lights ? UniformsUtils.clone(UniformsLib.lights) : {};
		const hue = source.uniforms.lampHue && { lampHue: { value: new Color(1, 1, 1) } };
		this.uniforms = { ...source.uniforms, ...lights, ...hue, ...own };
		this.follow();
	}

	/** Use the light of this scene, not of the fur's. */
	override onBeforeRender(renderer: WebGLRenderer, scene: Scene, _camera: Camera): void {
		followHue(this, scene);
		followEnvironmentMap(this, renderer, scene);
	}

	/** Copy the source's compiled parts and blending. */
	follow(): void {
		if (this.#version === this.#source.version) return;
		this.#version = this.#source.version;
		Material.prototype.copy.call(this, this.#source);
		const { BODY_LIGHT: _, ...parts } = this.#source.defines;
		const { ONE_HUE, ENVIRONMENT_MAP } = this.defines;
		const own = Object.entries({ ...parts, ONE_HUE, ENVIRONMENT_MAP, BODIES: '' });
		this.defines = inOrder(Object.fromEntries(own.filter(([, value]) => value !== undefined)));
		this.needsUpdate = true;
	}
}

/** Instances of bodies, `each` per body, of a geometry that shares the vertices of another. */
class Draw extends Mesh<InstancedBufferGeometry, ShaderMaterial> {
	/** Columns of the picture, as in `Fur`. */
	clip: FurColumns | undefined;
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

	/** Draws the faces of another geometry from now on, and owns what it does not share with the fur's. */
	wear({ index, attributes }: BufferGeometry): void {
		this.geometry.setIndex(index);
		for (const [name, attribute] of Object.entries(attributes)) this.geometry.setAttribute(name, attribute);
	}

	/** Draws `count` bodies from `drawn[first]` on. */
	put(drawn: Uint32Array, first: number, count: number, matrices: Float32Array, moved: boolean): void {
		// Attribute that the vertices may have received since.
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

	/** Frees all but attributes shared with the fur's own geometry. */
	override dispose(): void {
		super.dispose();
		this.removeFromParent();
		const { index, attributes } = this.#source;
		if (this.geometry.index === index) this.geometry.setIndex(null);
		for (const [name, shared] of Object.entries(attributes))
			if (this.geometry.getAttribute(name) === shared) this.geometry.deleteAttribute(name);
		this.geometry.dispose();
	}
}

/** One level of detail: all fins in one draw, all shells in another. */
export class BodyLevel {
	/** Body-major: all shells of the farthest body, the innermost first, then those of the next. */
	readonly shells: Draw;
	readonly fins: Draw | undefined;
	readonly #fur: Fur;
	readonly #most: number;
	readonly #material: BodyMaterial;
	/** Shells, alpha cut and crispness of each body, in the order of the draw. */
	readonly #details: InstancedBufferAttribute;

	/**
	 * @param most largest number of shells of a body
	 * @param capacity largest number of bodies
	 * @param finMaterial the caller's
	 * @param bounds of all bodies
	 */
	constructor(fur: Fur, most: number, capacity: number, finMaterial: BodyMaterial | undefined, bounds: Sphere) {
		const { shells, fins } = fur;
		this.#fur = fur;
		this.#most = most;
		// Equally distant objects are drawn by age: create fins before their shells.
		this.fins = fins && finMaterial && new Draw(fins.geometry, finMaterial, capacity, 1, bounds);
		this.#material = new BodyMaterial(shells.material, { shellCount: { value: most }, hardness: { value: 1 } });
		this.shells = new Draw(shells.geometry, this.#material, capacity, most, bounds);
		this.#details = new InstancedBufferAttribute(new Float32Array(4 * capacity), 4, false, most);
		this.shells.geometry.setAttribute('bodyDetail', this.#details);
		this.shells.name = `fur, up to ${most} shells`;
		if (this.fins) this.fins.name = `fins of fur, up to ${most} shells`;
	}

	/** Draws fewer faces from now on, if its bodies are far away. @param simplifier that leaves some out */
	simplify(surface: FarSurface, simplifier?: FurSimplifier): void {
		if (this.#most > FAR) return;
		const { asset, shells } = this.#fur;
		const far = surface.geometry(simplifier, moveOf(this.#fur, this.#most));
		this.shells.wear(far);
		if (!simplifier || asset.regions || 'MORPHS' in shells.material.defines) return;
		this.fins?.wear(farFins(this.#fur, far, Math.max(Math.floor(this.#most / SHELLS_A_STRIP), 1)));
	}

	/** Lets its draws follow the joints of poses. @param units the shells' axes → the body's */
	carry(poses: HerdPoses, units: Matrix4): void {
		for (const draw of [this.shells, this.fins]) if (draw) poses.carry(draw, units);
	}

	/**
	 * Draws `count` bodies from `drawn[first]` on.
	 *
	 * @param matrices matrices of all bodies
	 * @param details of all bodies
	 * @param moved whether the matrices have changed
	 */
	put(
		drawn: Uint32Array,
		first: number,
		count: number,
		matrices: Float32Array,
		{ values, texels }: BodyDetails,
		moved: boolean,
	): void {
		const fur = this.#fur;
		this.#material.follow();
		this.shells.receiveShadow = fur.shells.receiveShadow;
		this.shells.clip = fur.clip;
		this.shells.put(drawn, first, count, matrices, moved);
		const { array } = this.#details;
		for (let i = 0; i < 4 * count; i++) {
			const detail = values[4 * (drawn[first + (i >> 2)] as number) + (i & 3)] as number;
			if (array[i] === detail) continue;
			array[i] = detail;
			this.#details.needsUpdate = true;
		}
		// Bodies of a level are of about one size.
		parts.regions?.harden(this.#material, texels[drawn[first] as number] as number);
		if (!this.fins || !fur.fins) return;
		this.fins.receiveShadow = fur.fins.receiveShadow;
		this.fins.clip = fur.clip;
		this.fins.put(drawn, first, fur.fins.visible ? count : 0, matrices, moved);
	}

	/** Frees everything but the fur's. */
	dispose(): void {
		this.shells.dispose();
		this.fins?.dispose();
		this.#material.dispose();
	}
}

/** Shadow caster of all bodies, visible or not; draws nothing into the picture. */
export class BodyHull extends Draw {
	override readonly customDepthMaterial: BodyMaterial;
	readonly #fur: Fur;
	readonly #all: Uint32Array;
	#count = 0;

	/** @param material any in use already; nothing is drawn with it */
	constructor(fur: Fur, material: ShaderMaterial, capacity: number, bounds: Sphere) {
		super(fur.shells.geometry, material, capacity, 1, bounds);
		this.#fur = fur;
		this.customDepthMaterial = new BodyMaterial(fur.shells.customDepthMaterial);
		this.#all = Uint32Array.from({ length: capacity }, (_, i) => i);
		this.name = 'hull';
	}

	/** Casts the shadow of fewer faces, as bodies that are just far away have them. @param simplifier that leaves some out */
	simplify(surface: FarSurface, simplifier?: FurSimplifier): void {
		this.wear(surface.geometry(simplifier, moveOf(this.#fur, FAR)));
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
