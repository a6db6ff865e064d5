import type { Mesh } from 'three';
import type { FurTextures } from '../light/texels.ts';
import { needFur } from '../needFur.ts';
import type { FurMaterial } from '../shells/FurMaterial.ts';
import { BaselineMaterial } from './BaselineMaterial.ts';
import { DeepOpacityMaps, type MapOptions, type MappedFur } from './DeepOpacityMaps.ts';
import { LengyelMaterial, type LocalLight } from './LengyelMaterial.ts';
import { ShadowLayersMaterial } from './ShadowLayersMaterial.ts';
import { UnlitMaterial } from './UnlitMaterial.ts';

/** Method to light the shells: the fur's own, without light, or a baseline. */
export type FurMethodName = 'ptm' | 'unlit' | 'lengyel' | 'shadow-layers';

/** Options of `furMethod`. Directions of the hairs default to the asset's, if any. */
export interface FurMethodOptions extends LocalLight, MapOptions {
	/** Radiance of a white hair; `unlit` only. */
	brightness?: number;
}

/** Fur to light: a `Fur`. */
export interface FurMethodTarget extends MappedFur {
	/** Textures of the shells. */
	readonly textures: FurTextures;
	/** Method applied last, if any. */
	method: FurMethod | undefined;
}

/** A way to light the shells of a fur. */
export interface FurMethod {
	/** Name of the method. */
	readonly name: FurMethodName;
	/** Material of the shells. */
	readonly material: FurMaterial | BaselineMaterial;
	/** Puts the material on the shells; from then on `Fur.update` redraws the method's maps. Fins keep their own light. */
	apply(): void;
	/**
	 * Redraws maps that the frame looks up, if outdated.
	 *
	 * @returns whether anything was drawn
	 * @internal
	 */
	update(): boolean;
	/** Frees the method's resources and restores the shells' own material. */
	dispose(): void;
}

/**
 * Method of lighting a fur by name: `ptm`, its own, or a baseline on the same shells.
 *
 *     const method = furMethod(fur, 'shadow-layers', { renderer });
 *     method.apply();
 *     // each frame, before it is drawn
 *     fur.update(seconds);
 *
 * @throws Error for another name, and for `shadow-layers` without the option `renderer`
 */
export function furMethod(fur: FurMethodTarget, name: FurMethodName, given: FurMethodOptions = {}): FurMethod {
	needFur('furMethod', fur);
	const options = { direction: fur.textures.direction, ...given };
	const mesh: Mesh = fur.shells;
	const current = mesh.material;
	const own = current instanceof BaselineMaterial ? current.shells : fur.shells.material;
	const maps = name === 'shadow-layers' ? new DeepOpacityMaps(fur, own, options) : undefined;
	const material = maps ? new ShadowLayersMaterial(own, maps, options) : lit(name, own, options);
	const method: FurMethod = {
		name,
		material,
		apply() {
			mesh.material = material;
			fur.method = method;
		},
		update: () => maps?.update() ?? false,
		dispose() {
			if (fur.method === method) fur.method = undefined;
			if (mesh.material === material) mesh.material = own;
			if (material !== own) material.dispose();
			maps?.dispose();
		},
	};
	return method;
}

function lit(name: FurMethodName, own: FurMaterial, options: FurMethodOptions): FurMaterial | BaselineMaterial {
	if (name === 'unlit') return new UnlitMaterial(own, options);
	if (name === 'lengyel') return new LengyelMaterial(own, options);
	if (name === 'ptm') return own;
	throw new Error(`furMethod: got ${name}, expected ptm, unlit, lengyel or shadow-layers`);
}
