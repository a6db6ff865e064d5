import {
	BufferGeometry,
	type Camera,
	InstancedBufferGeometry,
	type IUniform,
	Matrix4,
	type Object3D,
	type Scene,
	Sphere,
	Vector3,
	Vector4,
	type WebGLRenderer,
} from 'three';
import { BodyCurvature } from '../body/BodyCurvature.ts';
import { sharedComb } from '../body/comb.ts';
import type { FurPose } from '../body/FurPose.ts';
import { PosedMesh } from '../body/PosedMesh.ts';
import { type FurAsset, tileOf } from '../format.ts';
import { BodyLight } from './BodyLight.ts';
import { beginClip, endClip, type FurColumns } from './clip.ts';
import type { FurMaterial } from './FurMaterial.ts';
import { HullMaterial } from './HullMaterial.ts';
import { coarserShare, crispnessFor, cutFor, pixelsPerUnit, shellsFor } from './lod.ts';
import { parts } from './parts/parts.ts';
import { followComb } from './switches.ts';

/** Largest number of shells. */
export const MAX_SHELLS = 256;

const eye = new Vector3();
const middle = new Vector3();
const viewport = new Vector4();
const inverse = new Matrix4();

/** First shell of a slab. @param each shells a slab */
const firstOf = (slab: number, each: number): number => Math.ceil((slab - 1e-4) * each - 0.5);

/** Shells of a furry surface: one instanced draw, instance = shell, the innermost first. */
export class FurShells extends PosedMesh<InstancedBufferGeometry, FurMaterial> {
	/** Draws the hull into shadow maps. */
	override readonly customDepthMaterial: HullMaterial;
	/** Whether the picture determines the number of shells; setting `shellCount` turns it off. */
	automatic = true;
	/** Spacing of automatic shells over 1.5 pixels, which are enough where pixels are small: 2 draws half as many. */
	coarseness = 1;
	/**
	 * How far shells that are hardly seen are drawn as one, the lowest, and as one a slab, those above: 1 takes a quarter to
	 * a half of them away and changes the picture a little, 0 draws all. In between it goes over without a step, with all
	 * of them. Herds draw all.
	 */
	merging = 0;
	/** Columns of the picture to draw; undefined: all. */
	clip: FurColumns | undefined;
	/** Width of a texel, model units. */
	readonly #texel: number;
	readonly #layers: number;
	/** Lamps at the body's vertices, for all shells; format 2.x. */
	readonly #light: BodyLight | undefined;
	/** Radius of the surface below, the mesh's own units. */
	#radius: number;
	/** Size in the pose over that at rest. */
	#stretch = 1;
	/** The shells' own material, whatever method lights them. */
	readonly #own: FurMaterial;

	/**
	 * @param surface the skin's vertices with normal, tangent, uv (tiles), _fur, _comb and color; or other shells'
	 * @param placement the node whose transform takes the surface's units to the model's; uniform scale
	 * @param pose of the body, if it has any
	 */
	constructor(surface: BufferGeometry, placement: Object3D, asset: FurAsset, material: FurMaterial, pose?: FurPose) {
		const geometry = new InstancedBufferGeometry();
		geometry.setIndex(surface.index);
		for (const [name, attribute] of Object.entries(surface.attributes)) geometry.setAttribute(name, attribute);
		super(geometry, material, pose);
		const comb = surface instanceof InstancedBufferGeometry ? undefined : sharedComb(surface);
		if (comb) geometry.setAttribute('_comb', comb);
		this.#own = material;
		followComb(this);
		this.name = 'fur';
		this.customDepthMaterial = new HullMaterial(material);
		this.castShadow = this.receiveShadow = true;
		this.position.copy(placement.position);
		this.quaternion.copy(placement.quaternion);
		this.scale.copy(placement.scale);

		const sphere = new Sphere();
		const position = surface.getAttribute('position');
		if (position) {
			const points = new BufferGeometry().setAttribute('position', position);
			points.computeBoundingSphere();
			sphere.copy(points.boundingSphere ?? sphere);
		}
		this.#radius = sphere.radius;
		geometry.boundingSphere = sphere;
		const { size, layers, length } = asset;
		this.#layers = layers;
		this.#texel = tileOf(asset) / size;
		if (material.means) {
			BodyCurvature.of(surface).mark(geometry);
			this.#light = new BodyLight(this, pose);
			this.add(this.#light);
		}
		// Lengths of the pelts' hairs in the mesh's own units, too.
		for (const short of (material.uniforms.shorts as IUniform<Vector4[]>).value) short.w *= this.scale.x;
		this.furLength = length;
	}

	/** Longest hairs, model units; of a fur, set `Fur.length`. */
	get furLength(): number {
		return this.material.furLength * this.scale.x;
	}

	set furLength(length: number) {
		this.material.furLength = length / this.scale.x;
		(this.geometry.boundingSphere as Sphere).radius = this.#radius + this.#stretch * this.material.furLength;
	}

	/** Fits the bounding sphere to the body's pose. @internal */
	fit({ sphere, unit }: FurPose): void {
		const bounds = this.geometry.boundingSphere as Sphere;
		bounds.copy(sphere).applyMatrix4(inverse.copy(this.matrixWorld).invert());
		this.#radius = bounds.radius;
		this.#stretch = unit / this.matrixWorld.getMaxScaleOnAxis();
		bounds.radius += this.#stretch * this.material.furLength;
	}

	/** Number of shells, 1 to 256, independent of the number of slabs; fractions are allowed. */
	get shellCount(): number {
		return this.material.shellCount;
	}

	set shellCount(value: number) {
		this.automatic = false;
		this.#draw(value);
	}

	#draw(value: number): void {
		const count = Math.min(Math.max(value, 1), MAX_SHELLS);
		this.material.shellCount = count;
		this.geometry.instanceCount = this.drawnShells;
	}

	/** Find the shells that stand for several: one for all that are hidden, one for each slab that is faint. */
	#merge(): void {
		const own = this.#own;
		if (!this.merging && !own.merged) return;
		const spared = this.#spared;
		const slabs = this.#layers * own.trim;
		const count = own.shellCount;
		const steps = Math.min(slabs, count); // slabs, or shells where these are fewer
		const hidden = Math.floor(own.hidden(0) * steps);
		const top = steps < slabs ? hidden : Math.floor(own.hidden(1) * steps);
		own.merged = hidden && this.merging;
		own.groups.set(firstOf(hidden, count / steps), top - hidden, hidden, firstOf(top, count / steps));
		if (this.#spared !== spared) this.geometry.instanceCount = this.drawnShells;
	}

	/** Number of shells that others stand for. */
	get #spared(): number {
		const { merged, groups } = this.#own;
		return merged === 1 ? groups.w - groups.y - 1 : 0;
	}

	/** Number of shells that are drawn: fewer than `shellCount` where some are merged. */
	get drawnShells(): number {
		return Math.ceil(this.shellCount) - this.#spared;
	}

	/** Set number of shells, alpha cut and crispness for this picture. */
	override onBeforeRender(renderer: WebGLRenderer, _scene: Scene, camera: Camera): void {
		if (this.material === this.#own) followComb(this);
		this.#light?.offer(renderer, camera);
		const { center, radius } = this.geometry.boundingSphere as Sphere;
		const unit = this.matrixWorld.getMaxScaleOnAxis() / this.scale.x; // world units per model unit
		const away = eye
			.setFromMatrixPosition(camera.matrixWorld)
			.distanceTo(middle.copy(center).applyMatrix4(this.matrixWorld));
		const near = Math.max(away - radius * this.scale.x * unit, 0.1 * away);
		const height = renderer.getCurrentViewport(viewport).w;
		if (this.automatic)
			this.#draw(
				shellsFor(this.furLength * unit * pixelsPerUnit(camera, height, near), this.#layers * this.material.trim) /
					this.coarseness,
			);
		this.#merge();
		const texel = this.#texel * unit * pixelsPerUnit(camera, height, away);
		this.material.alphaCut = cutFor(texel);
		this.material.crispness.set(crispnessFor(texel), coarserShare(texel));
		parts.regions?.harden(this.material, texel);
		this.material.uniformsNeedUpdate = true;
		beginClip(renderer, this.clip);
	}

	/** Restore the scissor. */
	override onAfterRender(renderer: WebGLRenderer): void {
		endClip(renderer, this.clip);
	}

	/** One hull casts the shadow of all shells. */
	override onBeforeShadow(): void {
		this.customDepthMaterial.follow();
		this.geometry.instanceCount = 1;
	}

	/** Restore the shells for the picture. */
	override onAfterShadow(): void {
		this.geometry.instanceCount = this.drawnShells;
	}

	/** Frees the geometry; material and textures belong to the fur. */
	override dispose(): void {
		super.dispose();
		this.#light?.dispose();
		this.geometry.dispose();
		this.customDepthMaterial.dispose();
	}
}
