import type { DirectionalLight, Mesh, WebGLRenderer } from 'three';
import type { Fur } from '../Fur.ts';
import type { FurMaterial } from '../FurMaterial.ts';
import { DeepOpacityMaps, type MapOptions } from './DeepOpacityMaps.ts';
import { LengyelMaterial, type LocalLight } from './LengyelMaterial.ts';
import type { MethodName } from './names.ts';
import { RivalMaterial } from './RivalMaterial.ts';
import { ShadowLayersMaterial } from './ShadowLayersMaterial.ts';
import { UnlitMaterial } from './UnlitMaterial.ts';

/** Directions of the hairs come from the asset, where it has them and none are given. */
export interface MethodOptions extends LocalLight, MapOptions {
	/** Of `unlit`: radiance of a white hair. */
	brightness?: number;
}

/** What a method has to know of a fur. */
export type Coat = Pick<Fur, 'shells' | 'skin' | 'textures'>;

/** A way to light the shells of a fur. */
export interface FurMethod {
	/** As `furMethod` takes it. */
	readonly name: MethodName;
	/** What it draws the shells with. */
	readonly material: FurMaterial | RivalMaterial;
	/** Puts it on the shells. Fins keep their own light. */
	wear(): void;
	/**
	 * To be called before every frame: draws what the frame looks up, if that has changed.
	 *
	 * @param light the scene's first directional light
	 * @returns whether anything was drawn
	 */
	before(renderer: WebGLRenderer, light: DirectionalLight): boolean;
	/** Frees what the method has made, and gives the shells their own material back. */
	dispose(): void;
}

/**
 * The light of a fur by its name: `ptm`, its own, or one of those that it is to be compared with, on the same shells.
 *
 *     const method = furMethod('shadow-layers', fur);
 *     method.wear();
 *     method.before(renderer, light);
 *     renderer.render(scene, camera);
 */
export function furMethod(name: MethodName, fur: Coat, given: MethodOptions = {}): FurMethod {
	const options = { direction: fur.textures.direction, ...given };
	const mesh: Mesh = fur.shells;
	const worn = mesh.material;
	const own = worn instanceof RivalMaterial ? worn.shells : fur.shells.material;
	const maps = name === 'shadow-layers' ? new DeepOpacityMaps(fur, own, options) : undefined;
	const material = maps ? new ShadowLayersMaterial(own, maps, options) : lit(name, own, options);
	return {
		name,
		material,
		wear() {
			mesh.material = material;
		},
		before: (renderer, light) => maps?.update(renderer, light) ?? false,
		dispose() {
			if (mesh.material === material) mesh.material = own;
			if (material !== own) material.dispose();
			maps?.dispose();
		},
	};
}

function lit(name: MethodName, own: FurMaterial, options: MethodOptions): FurMaterial | RivalMaterial {
	if (name === 'unlit') return new UnlitMaterial(own, options);
	if (name === 'lengyel') return new LengyelMaterial(own, options);
	return own;
}
