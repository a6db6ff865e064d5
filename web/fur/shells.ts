import {
	type BufferGeometry,
	InstancedBufferAttribute,
	InstancedBufferGeometry,
	Mesh,
	type Object3D,
	Sphere,
	Vector3,
} from 'three';
import { sharedComb } from './comb.ts';
import type { FurMaterial } from './FurMaterial.ts';
import type { FurAsset } from './format.ts';

/** The most shells that can be drawn. */
export const MAX_SHELLS = 256;

/** Shells per slab by default: side by side hairs turn from strings of beads into hairs. */
const SHELLS_PER_SLAB = 3;

/**
 * What shell `i` of `count` shows, written as (s, slab, shear u, shear v).
 *
 * Shells lie in the middle of their share of the fur. A shell between two slabs' middles shows its slab sheared by how
 * far the hairs have drifted since, so that they run on instead of standing in steps.
 */
export function shellParameters(i: number, count: number, drift: readonly (readonly [number, number])[]): number[] {
	const layers = drift.length;
	const s = (i + 0.5) / count;
	const slab = Math.min(Math.floor(s * layers), layers - 1);
	const [u, v] = driftAt(s, drift);
	const [slabU, slabV] = drift[slab] ?? [0, 0];
	return [s, slab, u - slabU, v - slabV];
}

/** Mean displacement of the hairs at height `s`: 0 at the root, linear between slab middles and on beyond the last. */
function driftAt(s: number, drift: readonly (readonly [number, number])[]): [number, number] {
	const knots = [{ s: 0, u: 0, v: 0 }, ...drift.map(([u, v], k) => ({ s: (k + 0.5) / drift.length, u, v }))];
	const next = knots.findIndex((knot) => knot.s > s);
	const after = next < 1 ? knots.length - 1 : next;
	const a = knots[after - 1];
	const b = knots[after];
	if (!a || !b) return [0, 0];
	const t = (s - a.s) / (b.s - a.s);
	return [a.u + t * (b.u - a.u), a.v + t * (b.v - a.v)];
}

/** The shells of a furry surface: one instanced draw, instance = shell, the innermost first. */
export class FurShells extends Mesh<InstancedBufferGeometry, FurMaterial> {
	readonly #asset: FurAsset;
	readonly #parameters = new InstancedBufferAttribute(new Float32Array(MAX_SHELLS * 4), 4);
	#shellCount = 0;

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
		geometry.setAttribute('shell', this.#parameters);
		this.name = 'fur';
		this.#asset = asset;
		this.position.copy(placement.position);
		this.quaternion.copy(placement.quaternion);
		this.scale.copy(placement.scale);
		material.furLength = asset.length / placement.scale.x;

		surface.computeBoundingSphere();
		const { center, radius } = surface.boundingSphere ?? new Sphere(new Vector3(), 0);
		geometry.boundingSphere = new Sphere(center.clone(), radius + material.furLength);
		this.shellCount = asset.layers * SHELLS_PER_SLAB;
	}

	/** How many shells are drawn, 1 to 256: any number, whatever the number of stored slabs. */
	get shellCount(): number {
		return this.#shellCount;
	}

	set shellCount(value: number) {
		const count = Math.min(Math.max(Math.round(value), 1), MAX_SHELLS);
		if (count === this.#shellCount) return;
		this.#shellCount = count;
		for (let i = 0; i < count; i++) this.#parameters.set(shellParameters(i, count, this.#asset.drift), i * 4);
		this.#parameters.needsUpdate = true;
		this.geometry.instanceCount = count;
		this.material.slabsPerShell = this.#asset.layers / count;
	}

	/** Frees the geometry; material and textures belong to the whole fur. */
	override dispose(): void {
		super.dispose();
		this.geometry.dispose();
	}
}
