/** Curvature of a body below its fur: sets the horizon of its hairs, and how far below it tips see. */

import { BufferAttribute, BufferGeometry, type InterleavedBufferAttribute, Matrix3, Vector3 } from 'three';
import { FurFollicles } from './FurFollicles.ts';

/** Rounds of averaging over neighbours, since normals are stored as bytes. */
const ROUNDS = 2;

type Attribute = BufferAttribute | InterleavedBufferAttribute;

const known = new WeakMap<Attribute, BodyCurvature>();

/**
 * Curvature tensors of a surface, from its positions and normals. S. Rusinkiewicz: Estimating Curvatures and Their
 * Derivatives on Triangle Meshes, 3DPVT 2004. Positive where the surface is convex.
 */
export class BodyCurvature {
	readonly #follicles: FurFollicles;
	/** Tensor of each follicle, per unit of the mesh: xx, yy, zz, xy, xz, yz. */
	#tensors: Float64Array;

	/** Curvature of a surface, shared by all furs of a body. */
	static of(surface: BufferGeometry): BodyCurvature {
		const position = surface.getAttribute('position');
		const curvature = known.get(position) ?? new BodyCurvature(surface);
		known.set(position, curvature);
		return curvature;
	}

	private constructor(surface: BufferGeometry) {
		this.#follicles = FurFollicles.of(surface);
		this.#tensors = this.#gather(surface);
		for (let round = 0; round < ROUNDS; round++) this.#smooth();
	}

	/** Area-weighted means of the faces' tensors, each turned into the tangent plane of the follicle. */
	#gather(surface: BufferGeometry): Float64Array {
		const { index } = surface;
		const at = this.#marks(surface);
		const corners = index?.count ?? at.count;
		const sums = new Float64Array(6 * this.#follicles.count);
		const areas = new Float64Array(this.#follicles.count);
		const points = [0, 1, 2].map(() => ({ i: 0, position: new Vector3(), normal: new Vector3() }));
		const [u, v, n] = [new Vector3(), new Vector3(), new Vector3()];
		const [side, turn, solved, squares] = [new Vector3(), new Vector3(), new Vector3(), new Matrix3()];
		const [turned, beside] = [new Vector3(), new Vector3()];
		for (let first = 0; first + 2 < corners; first += 3) {
			for (const [c, point] of points.entries()) {
				point.i = at.getX(index?.getX(first + c) ?? first + c);
				point.position.fromArray(this.#follicles.position, 3 * point.i);
				point.normal.fromArray(this.#follicles.normal, 3 * point.i);
			}
			const [a, b, c] = points as [(typeof points)[0], (typeof points)[0], (typeof points)[0]];
			u.subVectors(b.position, a.position);
			v.subVectors(c.position, a.position);
			n.crossVectors(u, v);
			const area = 0.5 * n.length();
			if (!(area > 0)) continue;
			n.normalize();
			u.normalize();
			v.crossVectors(n, u);
			// Least squares of Δn = II·Δp along the three sides: unknown are L, M, N in the axes u, v.
			let [aa, ab, bb, p, q, r] = [0, 0, 0, 0, 0, 0];
			for (const [from, to] of [
				[a, b],
				[b, c],
				[c, a],
			] as const) {
				side.subVectors(to.position, from.position);
				turn.subVectors(to.normal, from.normal);
				const [x, y, du, dv] = [side.dot(u), side.dot(v), turn.dot(u), turn.dot(v)];
				aa += x * x;
				ab += x * y;
				bb += y * y;
				p += x * du;
				q += y * du + x * dv;
				r += y * dv;
			}
			solved.set(p, q, r).applyMatrix3(squares.set(aa, ab, 0, ab, aa + bb, ab, 0, ab, bb).invert());
			const { x: l, y: m, z: k } = solved;
			for (const { i, normal } of points) {
				turnInto(turned.copy(u), n, normal);
				turnInto(beside.copy(v), n, normal);
				addTensor(sums, i, turned, beside, area * l, area * m, area * k);
				areas[i] = (areas[i] as number) + area;
			}
		}
		return sums.map((sum, j) => sum / (areas[Math.floor(j / 6)] || 1));
	}

	/** Average each follicle's tensor with its neighbours', turned into its tangent plane. */
	#smooth(): void {
		const { count, normal, first, links } = this.#follicles;
		const after = new Float64Array(this.#tensors.length);
		const [own, other, t, b] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
		const [turned, beside] = [new Vector3(), new Vector3()];
		for (let i = 0; i < count; i++) {
			const [from, to] = [first[i] as number, first[i + 1] as number];
			own.fromArray(normal, 3 * i);
			t.set(own.y, own.z, -own.x).cross(own).normalize();
			b.crossVectors(own, t);
			const share = to > from ? 0.5 : 1;
			let [tt, tb, bb] = [this.#along(i, t, t), this.#along(i, t, b), this.#along(i, b, b)].map(
				(own) => share * own,
			) as [number, number, number];
			for (let link = from; link < to; link++) {
				const j = links[link] as number;
				other.fromArray(normal, 3 * j);
				turnInto(turned.copy(t), own, other);
				turnInto(beside.copy(b), own, other);
				tt += (0.5 / (to - from)) * this.#along(j, turned, turned);
				tb += (0.5 / (to - from)) * this.#along(j, turned, beside);
				bb += (0.5 / (to - from)) * this.#along(j, beside, beside);
			}
			addTensor(after, i, t, b, tt, tb, bb);
		}
		this.#tensors = after;
	}

	/** Follicle at every vertex of a geometry in the axes of the surface; leaves the geometry unchanged. */
	#marks(geometry: BufferGeometry): Attribute {
		const stands = new BufferGeometry();
		for (const name of ['position', 'normal']) stands.setAttribute(name, geometry.getAttribute(name));
		this.#follicles.mark(stands);
		return stands.getAttribute('follicle');
	}

	/**
	 * Adds the attribute `curvature` to a geometry that lacks it: three numbers per vertex, per unit of the mesh, along the
	 * tangent, across it, and mixed.
	 *
	 * @param geometry the surface, or one in its axes, which takes the curvature of the nearest point
	 * @param hand sign of the axis across: w·hand·(normal × tangent)
	 */
	mark(geometry: BufferGeometry, hand: 1 | -1 = 1): void {
		if (geometry.hasAttribute('curvature')) return;
		const [normal, tangent] = [geometry.getAttribute('normal'), geometry.getAttribute('tangent')];
		const at = this.#marks(geometry);
		const values = new Float32Array(3 * at.count);
		const [n, t, b] = [new Vector3(), new Vector3(), new Vector3()];
		for (let i = 0; i < at.count; i++) {
			n.fromBufferAttribute(normal, i).normalize();
			t.fromBufferAttribute(tangent, i).addScaledVector(n, -n.dot(t)).normalize();
			b.crossVectors(n, t).multiplyScalar(hand * tangent.getW(i));
			const f = at.getX(i);
			values.set([this.#along(f, t, t), this.#along(f, b, b), this.#along(f, t, b)], 3 * i);
		}
		geometry.setAttribute('curvature', new BufferAttribute(values, 3));
	}

	#along(i: number, a: Vector3, b: Vector3): number {
		const part = (j: number) => this.#tensors[6 * i + j] as number;
		return (
			part(0) * a.x * b.x +
			part(1) * a.y * b.y +
			part(2) * a.z * b.z +
			part(3) * (a.x * b.y + a.y * b.x) +
			part(4) * (a.x * b.z + a.z * b.x) +
			part(5) * (a.y * b.z + a.z * b.y)
		);
	}
}

/** Turns a vector by the smallest rotation that takes one unit vector to another. */
function turnInto(vector: Vector3, from: Vector3, to: Vector3): void {
	const whole = 1 + from.dot(to);
	if (whole < 1e-6) return;
	// Rodrigues, for both unit vectors: v − (from + to)·((from + to)·v) / whole + 2·to·(from·v).
	const [along, ahead] = [(from.dot(vector) + to.dot(vector)) / whole, 2 * from.dot(vector)];
	vector.addScaledVector(from, -along).addScaledVector(to, ahead - along);
}

/** Adds tt·t·tᵀ + tb·(t·bᵀ + b·tᵀ) + bb·b·bᵀ. */
function addTensor(tensors: Float64Array, i: number, t: Vector3, b: Vector3, tt: number, tb: number, bb: number): void {
	const at = 6 * i;
	const [x, y, z] = [tt * t.x + tb * b.x, tt * t.y + tb * b.y, tt * t.z + tb * b.z];
	const [u, v, w] = [tb * t.x + bb * b.x, tb * t.y + bb * b.y, tb * t.z + bb * b.z];
	tensors[at] = (tensors[at] as number) + x * t.x + u * b.x;
	tensors[at + 1] = (tensors[at + 1] as number) + y * t.y + v * b.y;
	tensors[at + 2] = (tensors[at + 2] as number) + z * t.z + w * b.z;
	tensors[at + 3] = (tensors[at + 3] as number) + x * t.y + u * b.y;
	tensors[at + 4] = (tensors[at + 4] as number) + x * t.z + u * b.z;
	tensors[at + 5] = (tensors[at + 5] as number) + y * t.z + v * b.z;
}
