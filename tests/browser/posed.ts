/** Where a glTF's clips put its joints and its vertices, in plain numbers: the oracle of what moves. Free of three. */

/** Column-major, as in glTF. */
type Matrix = number[];

/** A glTF's JSON. */
// biome-ignore lint/suspicious/noExplicitAny: any glTF
export type Json = any;

const SIZES: Record<string, number> = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };
const READERS: Record<number, [bytes: number, read: (view: DataView, at: number) => number, most: number]> = {
	5120: [1, (view, at) => view.getInt8(at), 127],
	5121: [1, (view, at) => view.getUint8(at), 255],
	5122: [2, (view, at) => view.getInt16(at, true), 32767],
	5123: [2, (view, at) => view.getUint16(at, true), 65535],
	5125: [4, (view, at) => view.getUint32(at, true), 2 ** 32 - 1],
	5126: [4, (view, at) => view.getFloat32(at, true), 1],
};

function multiplied(a: Matrix, b: Matrix): Matrix {
	return Array.from({ length: 16 }, (_, i) => {
		let sum = 0;
		for (let k = 0; k < 4; k++) sum += (a[(i % 4) + 4 * k] ?? 0) * (b[4 * Math.floor(i / 4) + k] ?? 0);
		return sum;
	});
}

function composed({ matrix, translation, rotation, scale }: Json): Matrix {
	if (matrix) return matrix;
	const [x, y, z] = translation ?? [0, 0, 0];
	const [sx, sy, sz] = scale ?? [1, 1, 1];
	const [qx, qy, qz, qw] = rotation ?? [0, 0, 0, 1];
	return [
		...[sx * (1 - 2 * (qy * qy + qz * qz)), sx * 2 * (qx * qy + qz * qw), sx * 2 * (qx * qz - qy * qw), 0],
		...[sy * 2 * (qx * qy - qz * qw), sy * (1 - 2 * (qx * qx + qz * qz)), sy * 2 * (qy * qz + qx * qw), 0],
		...[sz * 2 * (qx * qz + qy * qw), sz * 2 * (qy * qz - qx * qw), sz * (1 - 2 * (qx * qx + qy * qy)), 0],
		...[x, y, z, 1],
	];
}

/** A glTF in a pose. */
export class PosedGltf {
	/** Nodes with the transforms of the pose. */
	readonly #nodes: Json[];
	readonly #weights = new Map<number, number[]>();

	/** @param buffers bytes of each buffer @param clip name of an animation; undefined: at rest */
	constructor(
		readonly json: Json,
		readonly buffers: Uint8Array[],
		clip?: string,
		seconds = 0,
	) {
		this.#nodes = json.nodes.map((node: Json) => ({ ...node }));
		const animation = json.animations?.find(({ name }: Json) => name === clip);
		if (clip && !animation) throw new Error(`no clip ${clip}`);
		for (const { sampler, target } of animation?.channels ?? []) {
			const { input, output, interpolation = 'LINEAR' } = animation.samplers[sampler];
			const value = this.#sampled(this.numbers(input), this.numbers(output), interpolation, target.path, seconds);
			if (target.path === 'weights') this.#weights.set(target.node, value);
			else this.#nodes[target.node][target.path] = value;
		}
	}

	/** Numbers of an accessor, normalised ones as the fractions that they stand for. */
	numbers(index: number): number[] {
		const { bufferView, byteOffset = 0, componentType, count, type, normalized, sparse } = this.json.accessors[index];
		const size = SIZES[type] as number;
		const read = (view: number, offset: number, kind: number, n: number, each: number, unit: boolean): number[] => {
			const { buffer, byteOffset: start = 0, byteStride } = this.json.bufferViews[view];
			const [bytes, get, most] = READERS[kind] as (typeof READERS)[number];
			const data = this.buffers[buffer] as Uint8Array;
			const values = new DataView(data.buffer, data.byteOffset + start + offset);
			const stride = byteStride ?? bytes * each;
			return Array.from({ length: n * each }, (_, i) => {
				const value = get(values, Math.floor(i / each) * stride + (i % each) * bytes);
				return unit ? Math.max(value / most, -1) : value;
			});
		};
		const all =
			bufferView === undefined
				? new Array(count * size).fill(0)
				: read(bufferView, byteOffset, componentType, count, size, normalized);
		if (sparse) {
			const { indices, values } = sparse;
			const at = read(indices.bufferView, indices.byteOffset ?? 0, indices.componentType, sparse.count, 1, false);
			const own = read(values.bufferView, values.byteOffset ?? 0, componentType, sparse.count, size, normalized);
			for (const [i, to] of at.entries()) for (let c = 0; c < size; c++) all[to * size + c] = own[i * size + c];
		}
		return all;
	}

	#sampled(times: number[], values: number[], interpolation: string, path: string, seconds: number): number[] {
		const cubic = interpolation === 'CUBICSPLINE';
		const size = values.length / times.length / (cubic ? 3 : 1);
		const key = (i: number, part = 1) => {
			const at = (cubic ? 3 * i + part : i) * size;
			return values.slice(at, at + size);
		};
		const after = times.findIndex((time) => time > seconds);
		if (after === 0) return key(0);
		if (after < 0) return key(times.length - 1);
		const [t0, t1] = [times[after - 1], times[after]] as [number, number];
		const s = (seconds - t0) / (t1 - t0);
		const [a, b] = [key(after - 1), key(after)];
		if (interpolation === 'STEP') return a;
		if (cubic) {
			const [out, into] = [key(after - 1, 2), key(after, 0)];
			const mixed = a.map(
				(value, c) =>
					(2 * s ** 3 - 3 * s ** 2 + 1) * value +
					(t1 - t0) * (s ** 3 - 2 * s ** 2 + s) * (out[c] ?? 0) +
					(3 * s ** 2 - 2 * s ** 3) * (b[c] ?? 0) +
					(t1 - t0) * (s ** 3 - s ** 2) * (into[c] ?? 0),
			);
			const length = path === 'rotation' ? Math.hypot(...mixed) : 1;
			return mixed.map((value) => value / length);
		}
		if (path !== 'rotation') return a.map((value, c) => value + s * ((b[c] ?? 0) - value));
		// Slerp the shorter way.
		let cosine = a.reduce((sum, value, c) => sum + value * (b[c] ?? 0), 0);
		const sign = cosine < 0 ? -1 : 1;
		cosine = Math.min(Math.abs(cosine), 1);
		const angle = Math.acos(cosine);
		const [wa, wb] =
			angle < 1e-4 ? [1 - s, s] : [Math.sin((1 - s) * angle) / Math.sin(angle), Math.sin(s * angle) / Math.sin(angle)];
		const mixed = a.map((value, c) => wa * value + wb * sign * (b[c] ?? 0));
		const length = Math.hypot(...mixed);
		return mixed.map((value) => value / length);
	}

	/** World matrix of a node. */
	world(index: number): Matrix {
		const parent = this.#nodes.findIndex(({ children = [] }) => children.includes(index));
		const own = composed(this.#nodes[index]);
		return parent < 0 ? own : multiplied(this.world(parent), own);
	}

	/** Weights of the morph targets of a node, the skin's for all of a body. */
	weights(node: number): number[] {
		const { mesh, weights } = this.#nodes[node];
		return this.#weights.get(node) ?? weights ?? this.json.meshes[mesh].weights ?? [];
	}

	/**
	 * World places of a node's vertices, primitive after primitive, three numbers each.
	 *
	 * @param weights of the morph targets
	 */
	vertices(node: number, weights = this.weights(node)): Float64Array {
		const { mesh, skin } = this.#nodes[node];
		const world = this.world(node);
		const places: number[] = [];
		for (const { attributes, targets = [] } of this.json.meshes[mesh].primitives) {
			const position = this.numbers(attributes.POSITION);
			targets.forEach((target: Json, t: number) => {
				if (!weights[t] || target.POSITION === undefined) return;
				for (const [i, change] of this.numbers(target.POSITION).entries())
					position[i] = (position[i] ?? 0) + (weights[t] ?? 0) * change;
			});
			const matrices: Matrix[] = [];
			if (skin !== undefined) {
				const { joints, inverseBindMatrices } = this.json.skins[skin];
				const inverse = this.numbers(inverseBindMatrices);
				for (const [j, joint] of joints.entries())
					matrices.push(multiplied(this.world(joint), inverse.slice(16 * j, 16 * j + 16)));
			}
			const joints = skin === undefined ? [] : this.numbers(attributes.JOINTS_0);
			const shares = skin === undefined ? [] : this.numbers(attributes.WEIGHTS_0);
			for (let v = 0; v < position.length / 3; v++) {
				const point = [position[3 * v] ?? 0, position[3 * v + 1] ?? 0, position[3 * v + 2] ?? 0, 1];
				const moved = [0, 0, 0];
				for (let k = 0; k < (skin === undefined ? 1 : 4); k++) {
					const matrix = skin === undefined ? world : (matrices[joints[4 * v + k] ?? 0] as Matrix);
					const share = skin === undefined ? 1 : (shares[4 * v + k] ?? 0);
					for (let row = 0; row < 3; row++)
						for (let c = 0; c < 4; c++)
							moved[row] = (moved[row] ?? 0) + share * (matrix[4 * c + row] ?? 0) * (point[c] ?? 0);
				}
				places.push(...moved);
			}
		}
		return Float64Array.from(places);
	}
}
