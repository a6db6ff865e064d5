import { BufferAttribute, type BufferGeometry, type Camera, DynamicDrawUsage, Matrix4, Vector3, Vector4 } from 'three';
import type { Jointed } from '../../body/FurPose.ts';

/** Numbers of an end of an edge: root, normals of the two faces, axis across the edge. */
const NUMBERS = 12;
/** As in fins.vert.glsl. */
const BROADSIDE = 0.15;
/** Rounding of the shader. */
const TOLERANCE = 1e-3;
/**
 * With joints cosines differ besides: by up to EVEN times where one stretches, beyond which all its fins are drawn, and by up
 * to √½ between two that are 90° apart.
 */
const STRETCHED = 0.03;
const BETWEEN = 0.065;
const EVEN = 1.2;
/** Joints of a vertex, and the weight below which one of them turns nothing. */
const JOINTS = 4;
const MIN_WEIGHT = 0.02;
/**
 * Share of the time between two frames that a choice for a body that moves may take, thrice as much once it is made, as frames
 * are short then; milliseconds of a fin until it is measured; and what is left of a measurement after a frame without a choice.
 */
const SHARE = 0.05;
const PER_FIN = 4e-4;
const FADING = 0.95;

const ATTRIBUTES = ['position', 'normal', 'tangent', '_edge', 'skinIndex', 'skinWeight'] as const;

const inverse = new Matrix4();
const place = new Vector3();
const n = new Vector3();
const edge = new Vector3();
const across = new Vector3();
const upright = new Vector3();
const eye = new Vector4();
const jointMatrix = new Matrix4();
const stretch = new Vector3();

/**
 * Fins that an eye sees at all, a tenth to a fifth of them: near the silhouette and not from their ends. The others have no
 * fragments, but each of their vertices would be posed and lit.
 *
 * Of a body with joints each joint has an eye, where it would be if that joint alone had moved the body from its rest. A fin
 * of several joints is seen as by an eye between theirs. A choice serves one camera: of two that see a body in turn, neither
 * finds it as it was.
 */
export class SeenFins {
	/** Numbers of all ends, four an edge. */
	#ends: Float32Array | undefined;
	/** Joints of all ends, four each, -1 for none; undefined without a skeleton. */
	#joints: Int16Array | undefined;
	/** Attributes that they were read from. */
	#read: unknown[] = [];
	#index: BufferAttribute | undefined;
	#count = 0;
	/** Eyes of the joints, or of the body, in the mesh's own axes at rest: points, or with W = 0 directions. */
	readonly #eyes: number[] = [];
	/** Whether they are those of the last choice. */
	#fresh = false;
	/** When a choice was wanted last, and what one takes, milliseconds. */
	#wanted = Number.NEGATIVE_INFINITY;
	#cost = 0;

	/** Indices of the last choice. */
	get index(): BufferAttribute | undefined {
		return this.#index;
	}

	/**
	 * @param fins of `strips` quads each, root to tip
	 * @param fade |n·v| of a face beyond which a fin is invisible
	 * @returns indices of the fins seen, in their order, and how many; undefined where the vertices are laid out otherwise,
	 * and where a body moves and choosing would take much of a frame
	 */
	choose(
		fins: Jointed & { geometry: BufferGeometry },
		camera: Camera,
		strips: number,
		fade: number,
	): { index: BufferAttribute; count: number } | undefined {
		const { geometry } = fins;
		const { index: all } = geometry;
		const { count = 0 } = geometry.getAttribute('position') ?? {};
		const edges = count / (2 * (strips + 1));
		if (all?.count !== 6 * strips * edges) return undefined;
		if (
			this.#index?.array.length !== all.count ||
			ATTRIBUTES.some((name, i) => geometry.attributes[name] !== this.#read[i])
		)
			this.#measure(geometry, edges, strips);
		const still = this.#look(fins, camera);
		const own = this.#index as BufferAttribute;
		if (this.#fresh && still) return { index: own, count: this.#count };
		const now = performance.now();
		const spare = SHARE * (this.#fresh ? 3 : 1) * (now - this.#wanted);
		this.#wanted = now;
		this.#fresh = !this.#joints || still || this.#cost < spare;
		if (!this.#fresh) {
			this.#cost *= FADING;
			return undefined;
		}
		this.#select(all.array, own, edges, 6 * strips, fade);
		this.#cost = performance.now() - now;
		return { index: own, count: this.#count };
	}

	/** Finds the eyes. @returns whether they are where they were */
	#look(fins: Jointed, camera: Camera): boolean {
		const flat = Number((camera as Camera & { isOrthographicCamera?: boolean }).isOrthographicCamera === true);
		const { skeleton, bindMatrix, bindMatrixInverse, matrixWorld } = fins;
		const bones = this.#joints && skeleton?.boneMatrices;
		const count = bones ? bones.length / 16 : 1;
		let still = true;
		for (let j = 0; j < count; j++) {
			inverse.copy(matrixWorld);
			if (bones)
				inverse
					.multiply(bindMatrixInverse as Matrix4)
					.multiply(jointMatrix.fromArray(bones, 16 * j))
					.multiply(bindMatrix as Matrix4);
			const { x, y, z } = stretch.setFromMatrixScale(inverse);
			// Without an eye no cosine is a number, and all is seen.
			if (bones && Math.max(x, y, z) > EVEN * Math.min(x, y, z)) eye.set(0, 0, 0, 0);
			else
				eye
					.set(0, 0, flat, 1 - flat)
					.applyMatrix4(camera.matrixWorld)
					.applyMatrix4(inverse.invert());
			for (let c = 0; c < 4; c++) {
				still &&= this.#eyes[4 * j + c] === eye.getComponent(c);
				this.#eyes[4 * j + c] = eye.getComponent(c);
			}
		}
		return still;
	}

	#measure(geometry: BufferGeometry, edges: number, strips: number): void {
		this.#read = ATTRIBUTES.map((name) => geometry.attributes[name]);
		const all = geometry.index as BufferAttribute;
		this.#index = new BufferAttribute(all.array.slice(), 1).setUsage(DynamicDrawUsage);
		this.#fresh = false;
		this.#cost = PER_FIN * edges;
		const [position, normal, tangent, turned, joints, weights] = ATTRIBUTES.map((name) => geometry.getAttribute(name));
		this.#ends = new Float32Array(4 * edges * NUMBERS);
		this.#joints = joints && weights && new Int16Array(4 * edges * JOINTS).fill(-1);
		if (!position || !normal || !tangent || !turned) return;
		const rows = strips + 1;
		for (let end = 0; end < 4 * edges; end++) {
			// Both roots, then both tips.
			const vertex = 2 * rows * (end >> 2) + (end & 1) + (end & 2 ? 2 * strips : 0);
			n.fromBufferAttribute(normal, vertex).normalize();
			edge.fromBufferAttribute(tangent, vertex).normalize();
			across.crossVectors(edge, n).normalize();
			upright.crossVectors(across, edge);
			place.fromBufferAttribute(position, vertex).toArray(this.#ends, NUMBERS * end);
			for (const face of [0, 1]) {
				const angle = Math.PI * turned.getComponent(vertex, face);
				n.copy(upright).multiplyScalar(Math.cos(angle)).addScaledVector(across, Math.sin(angle));
				n.toArray(this.#ends, NUMBERS * end + 3 + 3 * face);
			}
			across.toArray(this.#ends, NUMBERS * end + 9);
			for (let j = 0, free = JOINTS * end; this.#joints && j < JOINTS; j++)
				if ((weights as BufferAttribute).getComponent(vertex, j) >= MIN_WEIGHT)
					this.#joints[free++] = (joints as BufferAttribute).getComponent(vertex, j);
		}
	}

	/** @param each indices of a fin */
	#select(all: ArrayLike<number>, own: BufferAttribute, edges: number, each: number, fade: number): void {
		let count = 0;
		for (let i = 0; i < edges; i++) {
			if (
				!this.#seen(4 * i, fade) &&
				!this.#seen(4 * i + 1, fade) &&
				!this.#seen(4 * i + 2, fade) &&
				!this.#seen(4 * i + 3, fade)
			)
				continue;
			for (let k = 0; k < each; k++) own.array[count++] = all[each * i + k] as number;
		}
		this.#count = count;
		own.clearUpdateRanges();
		own.addUpdateRange(0, count);
		own.needsUpdate = true;
	}

	/** Whether finFade of fins.vert.glsl may be above 0 at an end. */
	#seen(end: number, fade: number): boolean {
		const joints = this.#joints;
		const ends = this.#ends as Float32Array;
		const eyes = this.#eyes;
		const at = NUMBERS * end;
		let broadside = 0;
		let least = 2;
		let most = -2;
		let count = 0;
		for (; count < (joints ? JOINTS : 1); count++) {
			const joint = joints ? (joints[JOINTS * end + count] as number) : 0;
			if (joint < 0) break;
			const w = eyes[4 * joint + 3] as number;
			const x = (eyes[4 * joint] as number) - w * (ends[at] as number);
			const y = (eyes[4 * joint + 1] as number) - w * (ends[at + 1] as number);
			const z = (eyes[4 * joint + 2] as number) - w * (ends[at + 2] as number);
			const far = Math.sqrt(x * x + y * y + z * z);
			const one = dot(ends, at + 3, x, y, z) / far;
			const other = dot(ends, at + 6, x, y, z) / far;
			broadside = Math.max(broadside, Math.abs(dot(ends, at + 9, x, y, z)) / far);
			least = Math.min(least, one, other);
			most = Math.max(most, one, other);
		}
		const tolerance = count > 1 ? BETWEEN : joints ? STRETCHED : TOLERANCE;
		if (broadside < BROADSIDE - tolerance) return false;
		// Both faces look to the viewer, or both away, by more than the fade.
		return !(least >= fade + tolerance || most <= -fade - tolerance);
	}
}

function dot(numbers: Float32Array, first: number, x: number, y: number, z: number): number {
	return (numbers[first] as number) * x + (numbers[first + 1] as number) * y + (numbers[first + 2] as number) * z;
}
