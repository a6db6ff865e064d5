import {
	BufferAttribute,
	type BufferGeometry,
	type Camera,
	DynamicDrawUsage,
	Matrix4,
	type Object3D,
	Vector3,
	Vector4,
} from 'three';

/** Numbers of an end of an edge: root, normals of the two faces, axis across the edge. */
const NUMBERS = 12;
/** As in fins.vert.glsl, with a tolerance for its rounding. */
const BROADSIDE = 0.15;
const TOLERANCE = 1e-3;

const ATTRIBUTES = ['position', 'normal', 'tangent', '_edge'] as const;

const inverse = new Matrix4();
const place = new Vector3();
const n = new Vector3();
const edge = new Vector3();
const across = new Vector3();
const upright = new Vector3();

/**
 * Fins that an eye sees at all, a tenth to a fifth of them: near the silhouette and not from their ends. The others have no
 * fragments, but each of their vertices would be lit. For bodies without a pose.
 */
export class SeenFins {
	/** Numbers of all ends, four an edge. */
	#ends: Float32Array | undefined;
	/** Attributes that they were read from. */
	#read: unknown[] = [];
	#index: BufferAttribute | undefined;
	#count = 0;
	/** Eye of the last choice, the mesh's own axes: a point, or with W = 0 a direction. */
	readonly #eye = new Vector4(Number.NaN);
	readonly #now = new Vector4();

	/** Indices of the last choice. */
	get index(): BufferAttribute | undefined {
		return this.#index;
	}

	/**
	 * @param fins of `strips` quads each, root to tip
	 * @param fade |n·v| of a face beyond which a fin is invisible
	 * @returns indices of the fins seen, in their order, and how many; undefined where the vertices are laid out otherwise
	 */
	choose(
		{ geometry, matrixWorld }: Object3D & { geometry: BufferGeometry },
		camera: Camera,
		strips: number,
		fade: number,
	): { index: BufferAttribute; count: number } | undefined {
		const { index: all } = geometry;
		const { count = 0 } = geometry.getAttribute('position') ?? {};
		const edges = count / (2 * (strips + 1));
		if (all?.count !== 6 * strips * edges) return undefined;
		if (
			this.#index?.array.length !== all.count ||
			ATTRIBUTES.some((name, i) => geometry.attributes[name] !== this.#read[i])
		)
			this.#measure(geometry, edges, strips);
		inverse.copy(matrixWorld).invert();
		const flat = (camera as Camera & { isOrthographicCamera?: boolean }).isOrthographicCamera === true;
		const from = this.#now.set(0, 0, flat ? 1 : 0, flat ? 0 : 1);
		from.applyMatrix4(camera.matrixWorld).applyMatrix4(inverse);
		const own = this.#index as BufferAttribute;
		if (!from.equals(this.#eye)) {
			this.#eye.copy(from);
			this.#select(all.array, own, edges, 6 * strips, fade);
		}
		return { index: own, count: this.#count };
	}

	#measure(geometry: BufferGeometry, edges: number, strips: number): void {
		this.#read = ATTRIBUTES.map((name) => geometry.attributes[name]);
		const all = geometry.index as BufferAttribute;
		this.#index = new BufferAttribute(all.array.slice(), 1).setUsage(DynamicDrawUsage);
		this.#eye.set(Number.NaN, 0, 0, 0);
		const [position, normal, tangent, turned] = ATTRIBUTES.map((name) => geometry.getAttribute(name));
		this.#ends = new Float32Array(4 * edges * NUMBERS);
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

	/** Whether finFade of fins.vert.glsl is above 0 at an end. */
	#seen(end: number, fade: number): boolean {
		const numbers = this.#ends as Float32Array;
		const { x, y, z, w } = this.#eye;
		const at = NUMBERS * end;
		const vx = x - w * (numbers[at] as number);
		const vy = y - w * (numbers[at + 1] as number);
		const vz = z - w * (numbers[at + 2] as number);
		const far = Math.hypot(vx, vy, vz);
		const towards = (first: number) =>
			((numbers[first] as number) * vx + (numbers[first + 1] as number) * vy + (numbers[first + 2] as number) * vz) /
			far;
		if (Math.abs(towards(at + 9)) < BROADSIDE - TOLERANCE) return false;
		const one = towards(at + 3);
		const other = towards(at + 6);
		return one * other <= 0 || Math.min(Math.abs(one), Math.abs(other)) < fade + TOLERANCE;
	}
}
