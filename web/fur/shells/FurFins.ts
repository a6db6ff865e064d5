import {
	BufferAttribute,
	BufferGeometry,
	type Camera,
	type InterleavedBufferAttribute,
	Matrix4,
	type Mesh,
	type Object3D,
	type Scene,
	Sphere,
	Vector3,
	type WebGLRenderer,
} from 'three';
import { BodyCurvature } from '../body/BodyCurvature.ts';
import type { FurPose } from '../body/FurPose.ts';
import { PosedMesh } from '../body/PosedMesh.ts';
import { beginClip, endClip, type FurColumns } from './clip.ts';
import type { FurFinMaterial } from './FurFinMaterial.ts';
import type { FurMaterial } from './FurMaterial.ts';
import { SeenFins } from './fins/SeenFins.ts';

/** Strips per fin where light changes with the height. */
const STRIPS = 4;

const everywhere = new Sphere(new Vector3(), Number.POSITIVE_INFINITY);

/**
 * The fins of a furry surface: one draw, before the shells.
 *
 * The renderer sorts transparent objects by the distance of their bounding spheres, then by age. So fins are created before
 * their shells and share placement and sphere with them, to the bit.
 */
export class FurFins extends PosedMesh<BufferGeometry, FurFinMaterial> {
	/** Columns of the picture to draw; undefined: all. */
	clip: FurColumns | undefined;
	readonly #seen = new SeenFins();
	/** Indices of all fins, which copies share, while only some are drawn. */
	#all: BufferAttribute | null = null;

	/**
	 * @param quads four vertices per edge with position (on the skin), normal, tangent (along the edge), uv (tiles along
	 * the edge, height 0..1), _edge and _fur
	 * @param pose of the body, if it has any
	 */
	constructor(quads: BufferGeometry, material: FurFinMaterial, pose?: FurPose) {
		super(material.means ? cutFins(quads, STRIPS) : quads, material, pose);
		this.name = 'fins';
		this.receiveShadow = true;
	}

	/**
	 * Joins the shells, sharing their placement.
	 *
	 * @param shells the shells that are drawn over these fins
	 * @param placement the node whose transform takes the quads' units to the model's
	 */
	join(shells: Mesh<BufferGeometry, FurMaterial>, placement: Object3D): void {
		for (const object of [shells, placement]) object.updateMatrix();
		if (!placement.matrix.equals(shells.matrix)) {
			const between = new Matrix4().copy(shells.matrix).invert().multiply(placement.matrix);
			const { geometry } = this;
			geometry.setAttribute('position', transformed(geometry.getAttribute('position'), between));
			// Changes have a length, but no place.
			between.setPosition(0, 0, 0);
			const { position } = geometry.morphAttributes;
			if (position) geometry.morphAttributes.position = position.map((changes) => transformed(changes, between));
		}
		this.position.copy(shells.position);
		this.quaternion.copy(shells.quaternion);
		this.scale.copy(shells.scale);
		if (this.material.means) BodyCurvature.of(shells.geometry).mark(this.geometry, -1);
		this.fit(shells);
	}

	/** Copies the shells' bounding sphere; call again when that changes. */
	fit(shells: Mesh<BufferGeometry, FurMaterial>): void {
		const longer = Math.max(this.material.finLength - 1, 0) * shells.material.furLength;
		this.geometry.boundingSphere ??= new Sphere();
		const sphere = this.geometry.boundingSphere.copy(shells.geometry.boundingSphere ?? everywhere);
		sphere.radius += longer;
	}

	/** Restrict the draw to `clip`, and to fins that the camera sees. */
	override onBeforeRender(renderer: WebGLRenderer, _scene: Scene, camera: Camera): void {
		beginClip(renderer, this.clip);
		const { geometry, material } = this;
		// Morph targets turn normals on the GPU alone.
		const turned = this.pose?.influences.some(Boolean);
		const seen = turned ? undefined : this.#seen.choose(this, camera, STRIPS, Number(material.defines.FADE_TO));
		if (!seen) return;
		this.#all = geometry.index;
		geometry.setIndex(seen.index).setDrawRange(0, seen.count);
	}

	/** Restore the scissor and all fins. */
	override onAfterRender(renderer: WebGLRenderer): void {
		if (this.#all) this.geometry.setIndex(this.#all).setDrawRange(0, Number.POSITIVE_INFINITY);
		this.#all = null;
		endClip(renderer, this.clip);
	}

	/** Frees the geometry; material and textures belong to the fur. */
	override dispose(): void {
		super.dispose();
		// On the GPU the indices of the fins seen end with the attributes.
		if (this.#seen.index) this.geometry.setAttribute('seen', this.#seen.index);
		this.geometry.dispose();
	}
}

/**
 * Cuts fins into strips from root to tip, so that light follows the height.
 *
 * @param quads four vertices per edge: root, root, tip, tip, first end before second
 */
export function cutFins(quads: BufferGeometry, strips: number): BufferGeometry {
	if (quads.userData.strips === strips) return quads;
	const cut = new BufferGeometry();
	const rows = strips + 1;
	const edges = quads.getAttribute('position').count / 4;
	const count = edges * rows * 2;
	/** Root below a vertex of the strips. */
	const rootOf = (vertex: number) => 4 * Math.floor(vertex / (2 * rows)) + (vertex % 2);
	for (const [name, attribute] of Object.entries(quads.attributes)) {
		// Joints are numbers, not quantities: all of a fin follows its roots.
		if (name === 'skinIndex' || name === 'skinWeight') {
			cut.setAttribute(name, copiesOf(attribute, count, rootOf));
			continue;
		}
		const { itemSize } = attribute;
		const values = new Float32Array(count * itemSize);
		for (let vertex = 0, at = 0; vertex < count; vertex++) {
			const share = (Math.floor(vertex / 2) % rows) / strips;
			const root = rootOf(vertex);
			for (let c = 0; c < itemSize; c++, at++)
				values[at] = attribute.getComponent(root, c) * (1 - share) + attribute.getComponent(root + 2, c) * share;
		}
		cut.setAttribute(name, new BufferAttribute(values, itemSize));
	}
	for (const [name, targets] of Object.entries(quads.morphAttributes))
		cut.morphAttributes[name as 'position'] = targets.map((changes) => copiesOf(changes, count, rootOf));
	cut.morphTargetsRelative = quads.morphTargetsRelative;
	const corners = Array.from({ length: edges * strips }, (_, i) => {
		const first = 2 * (Math.floor(i / strips) * rows + (i % strips));
		return [first, first + 1, first + 3, first, first + 3, first + 2];
	});
	cut.setIndex(corners.flat());
	cut.userData.strips = strips;
	return cut;
}

function transformed(position: BufferAttribute | InterleavedBufferAttribute, matrix: Matrix4): BufferAttribute {
	const moved = new BufferAttribute(new Float32Array(position.count * 3), 3);
	const vertex = new Vector3();
	for (let i = 0; i < position.count; i++) {
		vertex
			.fromBufferAttribute(position, i)
			.applyMatrix4(matrix)
			.toArray(moved.array, i * 3);
	}
	return moved;
}

/** An attribute of `count` vertices, each a copy of one of another attribute. */
function copiesOf(
	attribute: BufferAttribute | InterleavedBufferAttribute,
	count: number,
	sourceOf: (vertex: number) => number,
): BufferAttribute {
	const { itemSize, normalized, array } = attribute;
	const { data, offset = 0 } = attribute as Partial<InterleavedBufferAttribute>;
	const stride = data?.stride ?? itemSize;
	const values = new (array.constructor as Float32ArrayConstructor)(count * itemSize);
	for (let vertex = 0; vertex < count; vertex++)
		for (let c = 0; c < itemSize; c++)
			values[vertex * itemSize + c] = array[sourceOf(vertex) * stride + offset + c] as number;
	return new BufferAttribute(values, itemSize, normalized);
}
