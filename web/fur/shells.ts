import {
	BufferGeometry,
	type Camera,
	InstancedBufferGeometry,
	Mesh,
	type Object3D,
	type Scene,
	Sphere,
	Vector3,
	Vector4,
	type WebGLRenderer,
} from 'three';
import { beginClip, type Columns, endClip } from './clip.ts';
import { sharedComb } from './comb.ts';
import { BodyCurvature } from './curvature.ts';
import type { FurMaterial } from './FurMaterial.ts';
import type { FurAsset } from './format.ts';
import { HullMaterial } from './HullMaterial.ts';
import { cutFor, pixelsPerUnit, shellsFor } from './lod.ts';

/** The most shells that can be drawn. */
export const MAX_SHELLS = 256;

const eye = new Vector3();
const middle = new Vector3();
const viewport = new Vector4();

/** The shells of a furry surface: one instanced draw, instance = shell, the innermost first. */
export class FurShells extends Mesh<InstancedBufferGeometry, FurMaterial> {
	/** Draws the hull into shadow maps. */
	override readonly customDepthMaterial: HullMaterial;
	/** Whether there are as many shells as the picture needs, or as many as `shellCount` was last set to. */
	automatic = true;
	/** Spacing of automatic shells over what looks best: 2 draws half as many. */
	coarseness = 1;
	/** Columns of the picture in which they are drawn; undefined: all. */
	clip: Columns | undefined;
	/** Of a texel, model units. */
	readonly #texel: number;
	readonly #layers: number;
	/** Where lamps and sky go below the surface's own horizon. */
	/** Of the surface below, the mesh's own units. */
	readonly #radius: number;

	/**
	 * @param surface the skin's vertices with normal, tangent, uv (tiles), _fur, _comb and color; or other shells'
	 * @param placement the node whose transform takes the surface's units to the model's; uniform scale
	 */
	constructor(surface: BufferGeometry, placement: Object3D, asset: FurAsset, material: FurMaterial) {
		const geometry = new InstancedBufferGeometry();
		geometry.setIndex(surface.index);
		for (const [name, attribute] of Object.entries(surface.attributes)) geometry.setAttribute(name, attribute);
		super(geometry, material);
		const comb = surface instanceof InstancedBufferGeometry ? undefined : sharedComb(surface);
		if (comb) geometry.setAttribute('_comb', comb);
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
		const { size, layers, length, height } = asset;
		this.#layers = layers;
		this.#texel = length / (height * size);
		if (material.means) BodyCurvature.of(surface).mark(geometry);
		this.furLength = length;
	}

	/** Longest fur, model units. */
	get furLength(): number {
		return this.material.furLength * this.scale.x;
	}

	set furLength(length: number) {
		this.material.furLength = length / this.scale.x;
		(this.geometry.boundingSphere as Sphere).radius = this.#radius + this.material.furLength;
	}

	/** How many shells are drawn, 1 to 256: any number, whatever the number of stored slabs, and between whole ones, too. */
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
		this.geometry.instanceCount = Math.ceil(count);
	}

	/** As many shells, and cut as low, as this picture needs. */
	override onBeforeRender(renderer: WebGLRenderer, _scene: Scene, camera: Camera): void {
		const { center, radius } = this.geometry.boundingSphere as Sphere;
		const unit = this.matrixWorld.getMaxScaleOnAxis() / this.scale.x; // of the model, world units
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
		this.material.alphaCut = cutFor(this.#texel * unit * pixelsPerUnit(camera, height, away));
		this.material.uniformsNeedUpdate = true;
		beginClip(renderer, this.clip);
	}

	/** Other objects have the whole picture. */
	override onAfterRender(renderer: WebGLRenderer): void {
		endClip(renderer, this.clip);
	}

	/** One hull casts the shadow of all shells. */
	override onBeforeShadow(): void {
		this.customDepthMaterial.follow();
		this.geometry.instanceCount = 1;
	}

	/** The shells are back for the picture. */
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
