import {
	type Camera,
	OneFactor,
	OneMinusSrcAlphaFactor,
	type Scene,
	ShaderMaterial,
	type ShaderMaterialParameters,
	type Texture,
	type WebGLRenderer,
	ZeroFactor,
} from 'three';
import { PeltLight } from '../light/PeltLight.ts';
import { CONTRAST, codings, type FurTextures, type SlabMeanCurves, type TexelCoding } from '../light/texels.ts';
import { type Stained, stain } from '../weather/stains.ts';
import { followEnvironmentMap } from './environmentMap.ts';
import { followHue } from './hue.ts';
import { peltParameters } from './parts/peltParameters.ts';
import { inOrder, mirrorUniforms, switchPart } from './switches.ts';

/** Common base of the materials of shells and fins: texels of coefficients times light moments. */
export class PeltMaterial extends ShaderMaterial {
	readonly #followers: PeltMaterial[] = [];
	readonly #leader: PeltMaterial | undefined;
	readonly #light: PeltLight;
	#contrast = CONTRAST;
	/** Coding of each fur's texels, the coat first. @internal */
	readonly furs: readonly TexelCoding[];

	/**
	 * @param furs coding of each fur's texels, the coat first
	 * @param parameters own shaders (after the common chunks), uniforms and defines
	 * @param mirrored names of uniforms that become properties of the material
	 * @param leader material whose switches this one follows
	 */
	constructor(
		furs: readonly TexelCoding[],
		textures: FurTextures,
		parameters: ShaderMaterialParameters,
		mirrored: readonly string[],
		leader?: PeltMaterial,
	) {
		const planes = [textures.plane0, textures.plane1].filter((plane) => plane !== undefined);
		const { LAYERS, FIN } = parameters.defines ?? {};
		const light = new PeltLight(furs, planes, Number(LAYERS), FIN !== undefined, leader ? leader.#light : undefined);
		super(peltParameters(furs, textures, light.uniforms, parameters));
		this.defines = inOrder(this.defines);
		// Defaults of absent attributes: white, full weight, full length, open, first tip colour.
		Object.assign(this.defaultAttributeValues, {
			color: [1, 1, 1, 1],
			_fur: [1, 1, 1, 0],
			_comb: [0, 0, 0],
			_edge: [0, 0, 0, 0],
			follicle: [0],
			curvature: [0, 0, 0],
			_region: [0, 1, 0],
		});
		mirrorUniforms(this, mirrored);
		this.furs = furs;
		this.#leader = leader;
		this.#light = light;
		this.setTextures(textures);
		if (leader) leader.#followers.push(this);
	}

	/** Mean curves with the dry pelt's weights; format 2.x only. @internal */
	get means(): SlabMeanCurves | undefined {
		return this.#light.means;
	}

	get #all(): PeltMaterial[] {
		return [this, ...this.#followers];
	}

	/** Whether ambient and hemisphere lights, light probes and `scene.environment` count. A fragment costs less without. */
	get environment(): boolean {
		return 'SKY' in this.defines;
	}

	set environment(on: boolean) {
		this.#switch('SKY', on);
	}

	/**
	 * Strength of the highlights along the hairs, one white and one of their colour; the white one is weaker on dark and on
	 * deep colours. 0 costs nothing.
	 */
	get gloss(): number {
		return this.uniforms.gloss?.value;
	}

	set gloss(strength: number) {
		this.#set('gloss', strength, strength > 0);
	}

	/** Strength of light through the hairs from behind, 40 for real hair; 0 costs nothing. */
	get backlight(): number {
		return this.uniforms.backlight?.value;
	}

	set backlight(strength: number) {
		this.#set('backlight', strength, strength > 0);
	}

	/**
	 * Thickness of skin from which on no light comes through from behind, world units; thinner parts that are leaves, such as
	 * ears, glow, limbs do not. By the shadow map of a directional lamp; 0 costs nothing. {@link Fur.extent} gives a measure.
	 */
	get glow(): number {
		return this.uniforms.glow?.value;
	}

	set glow(thickness: number) {
		this.#set('glow', thickness, thickness > 0);
	}

	/**
	 * Number of hairs over the baked number, 0.1 to 3: coverage α becomes 1 − (1 − α)^density; light and shadows stay as
	 * baked. 1 costs nothing.
	 */
	get density(): number {
		return this.uniforms.density?.value;
	}

	set density(ratio: number) {
		this.#set('density', ratio, ratio !== 1);
	}

	/**
	 * Contrast of light from texel to texel of a slab over the stored one's, in a PTM with mean curves; 1.4 by itself, which is
	 * as much as real hairs have. Costs nothing.
	 */
	get contrast(): number {
		return this.#contrast;
	}

	set contrast(ratio: number) {
		for (const material of this.#all) {
			material.#contrast = ratio;
			for (const [name, value] of Object.entries(codings(material.furs, ratio))) {
				const uniform = material.uniforms[name];
				if (uniform) uniform.value = value;
			}
		}
	}

	/**
	 * Displacement of hairs beyond their comb, a texel per follicle: XYZ = displacement of the tip in the tangent plane, share
	 * of the length, the mesh's own axes; with the comb no longer than 0.8. Needs the attribute `follicle`. Undefined costs
	 * nothing.
	 */
	get swing(): Texture | undefined {
		return this.uniforms.swing?.value ?? undefined;
	}

	set swing(texture: Texture | undefined) {
		const { swing } = this.uniforms;
		if (swing) swing.value = texture ?? null;
		this.#switch('SWING', texture !== undefined);
	}

	/**
	 * β, radius of the whole body in lengths of its fur; sets how far below the horizon light counts in format 1.x. Format 2.x
	 * uses the surface's own curvature.
	 */
	get bodyRadius(): number {
		return this.uniforms.bodyRadius?.value;
	}

	set bodyRadius(radius: number) {
		const { bodyRadius } = this.uniforms;
		if (bodyRadius) bodyRadius.value = radius;
	}

	/**
	 * Share of the hairs' length left after a cut, above 0 to 1: the lowest slabs at their own thickness, in the light that
	 * they get without the hair above. 1 costs nothing.
	 */
	get trim(): number {
		return this.uniforms.furTrim?.value;
	}

	set trim(share: number) {
		if (this.#leader) this.#leader.trim = share;
		if (share === this.trim) return;
		const { furTrim } = this.uniforms;
		if (furTrim) furTrim.value = share;
		const places = share < 1 ? this.#light.places(share) : undefined;
		for (const material of this.#all) material.#light.cut(places);
		this.#switch('TRIMMED', share < 1);
	}

	/** Share of the fur's height, from the skin, that is hardly seen (0) or faint (1); less where it is thinner than baked. @internal */
	hidden(which: 0 | 1): number {
		return (this.#light.hidden(this.trim)[which] as number) * Math.min(this.density, 1);
	}

	/** Switch to the cheaper sum for lamps of one hue, and to the light of the scene's environment. */
	override onBeforeRender(renderer: WebGLRenderer, scene: Scene, _camera: Camera): void {
		followHue(this, scene);
		followEnvironmentMap(this, renderer, scene);
	}

	/** Frees everything but the pelt's textures. */
	override dispose(): void {
		super.dispose();
		this.#light.dispose();
	}

	/**
	 * Whether lamps are summed per fragment, not per vertex: exact light on coarse meshes and exact shadows of all lamps, at a
	 * high cost.
	 */
	get lampsPerFragment(): boolean {
		return 'LAMPS_PER_FRAGMENT' in this.defines;
	}

	set lampsPerFragment(on: boolean) {
		this.#switch('LAMPS_PER_FRAGMENT', on);
	}

	/**
	 * Whether hairs cover samples of a multisampled target instead of being blended: independent of the order of draws, but
	 * grainy. The background has to be opaque, since the target's alpha is left alone.
	 */
	get multisampled(): boolean {
		return this.alphaToCoverage;
	}

	set multisampled(on: boolean) {
		for (const material of this.#all) {
			if (material.alphaToCoverage === on) continue;
			material.alphaToCoverage = on;
			material.blendDst = on ? ZeroFactor : OneMinusSrcAlphaFactor;
			material.blendSrcAlpha = on ? ZeroFactor : null;
			material.blendDstAlpha = on ? OneFactor : null;
			material.needsUpdate = true;
		}
	}

	/** Draw the coat alone, all over a body with several furs or by a pelt of several. @internal */
	set oneFur(on: boolean) {
		this.#switch('ONE_FUR', on);
	}

	/** @param on whether the value has any effect */
	#set(name: 'gloss' | 'backlight' | 'glow' | 'density', value: number, on: boolean): void {
		const uniform = this.uniforms[name];
		if (uniform) uniform.value = value;
		this.#switch(name.toUpperCase(), on);
	}

	#switch(define: string, on: boolean): void {
		this.#compile(define, on ? '' : undefined);
	}

	/** Compile a part of the shaders in or out, here and in materials that follow this one. */
	#compile(define: string, value: string | number | undefined): void {
		for (const material of this.#all) switchPart(material, define, value);
	}

	/** Sets wet or dirty fur, as far as the textures hold it. Needs the attribute `follicle`. Undefined costs nothing. */
	setStains(stained: Stained | undefined): void {
		const parts = stain(this.uniforms, stained);
		for (const [define, value] of Object.entries(parts)) this.#compile(define, value);
		const states = parts.WET ? stained?.wet : undefined;
		for (const material of this.#all) material.#light.show(states);
	}

	/** Replaces the planes: others of the same shape, or several states of the fur, one after the other. */
	setTextures({ plane0, plane1, colour }: FurTextures): void {
		for (const [name, value] of Object.entries({ plane0, plane1: plane1 ?? null, colourPlane: colour ?? null })) {
			const uniform = this.uniforms[name];
			if (uniform) uniform.value = value;
		}
	}
}
