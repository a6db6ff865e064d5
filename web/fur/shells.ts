import { type BufferGeometry, InstancedBufferGeometry, Mesh, type Object3D, Sphere, Vector3 } from 'three';
import { sharedComb } from './comb.ts';
import type { FurMaterial } from './FurMaterial.ts';
import type { FurAsset } from './format.ts';
import { HullMaterial } from './HullMaterial.ts';

/** The most shells that can be drawn. */
export const MAX_SHELLS = 256;

/** Shells per slab by default: side by side hairs turn from strings of beads into hairs. */
const SHELLS_PER_SLAB = 3;

/** The shells of a furry surface: one instanced draw, instance = shell, the innermost first. */
export class FurShells extends Mesh<InstancedBufferGeometry, FurMaterial> {
	override readonly customDepthMaterial: HullMaterial;

	/**
	 * @param surface the skin's vertices with normal, tangent, uv (tiles), _fur, _comb and color
	 * @param placement the node whose transform takes the surface's units to the model's; uniform scale
	 */
	constructor(surface: BufferGeometry, placement: Object3D, asset: FurAsset, material: FurMaterial) {
		const geometry = new InstancedBufferGeometry();
		geometry.setIndex(surface.index);
		for (const [name, attribute] of Object.entries(surface.attributes)) geometry.setAttribute(name, attribute);
		super(geometry, material);
		const comb = sharedComb(surface);
		if (comb) geometry.setAttribute('_comb', comb);
		this.name = 'fur';
		this.customDepthMaterial = new HullMaterial(material);
		this.castShadow = this.receiveShadow = true;
		this.position.copy(placement.position);
		this.quaternion.copy(placement.quaternion);
		this.scale.copy(placement.scale);
		material.furLength = asset.length / placement.scale.x;

		surface.computeBoundingSphere();
		const { center, radius } = surface.boundingSphere ?? new Sphere(new Vector3(), 0);
		geometry.boundingSphere = new Sphere(center.clone(), radius + material.furLength);
		this.shellCount = asset.layers * SHELLS_PER_SLAB;
	}

	/** How many shells are drawn, 1 to 256: any number, whatever the number of stored slabs, and between whole ones, too. */
	get shellCount(): number {
		return this.material.shellCount;
	}

	set shellCount(value: number) {
		const count = Math.min(Math.max(value, 1), MAX_SHELLS);
		this.material.shellCount = count;
		this.geometry.instanceCount = Math.ceil(count);
	}

	/** One hull casts the shadow of all shells. */
	override onBeforeShadow(): void {
		this.geometry.instanceCount = 1;
	}

	override onAfterShadow(): void {
		this.geometry.instanceCount = Math.ceil(this.shellCount);
	}

	/** Frees the geometry; material and textures belong to the whole fur. */
	override dispose(): void {
		super.dispose();
		this.geometry.dispose();
		this.customDepthMaterial.dispose();
	}
}
