/** Where a body is in the course of a clip: its box at every moment, and how low its points come. */

import { Box3, type BufferAttribute, type Mesh, SkinnedMesh, Vector3 } from 'three';
import { PosedVertices } from './PosedVertices.ts';

/** Samples of a clip: per second, and at least and at most. */
const [RATE, MIN_STEPS, MAX_STEPS] = [12, 8, 48];

/** Directions in which a body's parts are measured: of a cube's faces, edges and corners. */
const DIRECTIONS = [-1, 0, 1]
	.flatMap((x) => [-1, 0, 1].flatMap((y) => [-1, 0, 1].map((z) => new Vector3(x, y, z).normalize())))
	.filter((direction) => direction.lengthSq() > 0);

/** Points that stand for a mesh in all its poses. */
export interface Outline {
	vertices: PosedVertices;
	/** places at rest, the body at its place in the file */
	rests: readonly Vector3[];
}

/** A point of the body, and how low it comes. */
export interface LowPoint {
	/** at rest, at the body's place in the file */
	rest: Vector3;
	/** smallest height in the course of the clip */
	height: number;
}

const place = new Vector3();
const from = new Box3();
const to = new Box3();

/** Outermost vertices of a mesh: of each part that one joint moves most, with each morph target. */
function outermost(mesh: Mesh): Uint32Array {
	const { attributes, morphAttributes, morphTargetsRelative } = mesh.geometry;
	const position = attributes.position as BufferAttribute;
	const [index, weight] = mesh instanceof SkinnedMesh ? [attributes.skinIndex, attributes.skinWeight] : [];
	const targets = [undefined, ...(morphAttributes.position ?? [])] as (BufferAttribute | undefined)[];
	// The vertex farthest in a direction, and how far, by part.
	const parts = new Map<number, { vertex: Uint32Array; far: Float64Array }>();
	for (let v = 0; v < position.count; v++) {
		let joint = 0;
		for (let k = 1; index && weight && k < 4; k++)
			if (weight.getComponent(v, k) > weight.getComponent(v, joint)) joint = k;
		const part = index ? index.getComponent(v, joint) : 0;
		targets.forEach((target, t) => {
			place.fromBufferAttribute(position, v);
			if (target && !morphTargetsRelative) place.setScalar(0);
			if (target) for (const c of [0, 1, 2]) place.setComponent(c, place.getComponent(c) + target.getComponent(v, c));
			const key = part * targets.length + t;
			let best = parts.get(key);
			if (!best) {
				const far = new Float64Array(DIRECTIONS.length).fill(Number.NEGATIVE_INFINITY);
				best = { vertex: new Uint32Array(DIRECTIONS.length), far };
				parts.set(key, best);
			}
			for (let d = 0; d < DIRECTIONS.length; d++) {
				const far = place.dot(DIRECTIONS[d] as Vector3);
				if (far <= (best.far[d] as number)) continue;
				best.far[d] = far;
				best.vertex[d] = v;
			}
		});
	}
	return Uint32Array.from(new Set([...parts.values()].flatMap(({ vertex }) => [...vertex])));
}

/** Box around a body, and radius of the sphere around its centre that holds it. */
export interface Room {
	box: Box3;
	radius: number;
}

/** How far a clip may leave the room of the body at rest, share of its radius: breathing moves no camera. */
const SLACK = 0.06;

export class Reach {
	/** Box around the body in the whole clip, and radius around its centre that holds the body. */
	readonly box = new Box3();
	readonly radius: number;
	/** Its points, lowest first. */
	readonly low: readonly LowPoint[];
	readonly #duration: number;
	readonly #steps: number;
	/** Least and largest coordinates, by sample. */
	readonly #boxes: Float32Array;

	/**
	 * Points that stand for a body in all its poses.
	 *
	 * @param meshes at their place in the file, in the pose of the file
	 */
	static outline(meshes: readonly Mesh[]): Outline[] {
		return meshes.map((mesh) => {
			const vertices = new PosedVertices(mesh, outermost(mesh));
			const at = (i: number) => new Vector3().fromArray(vertices.rest, 3 * i).applyMatrix4(mesh.matrixWorld);
			return { vertices, rests: Array.from({ length: vertices.rest.length / 3 }, (_, i) => at(i)) };
		});
	}

	/**
	 * Samples a clip.
	 *
	 * @param outline as of `outline`
	 * @param duration of the clip, seconds
	 * @param pose brings the body to a moment of the clip
	 * @param rest room of the body at rest: that of the clip, too, which hardly leaves it
	 */
	constructor(outline: readonly Outline[], duration: number, pose: (time: number) => void, rest?: Room) {
		this.#duration = duration;
		this.#steps = Math.min(Math.max(Math.ceil(RATE * duration), MIN_STEPS), MAX_STEPS);
		this.#boxes = new Float32Array(6 * (this.#steps + 1));
		const far = DIRECTIONS.map(() => ({ reach: Number.NEGATIVE_INFINITY, place: new Vector3() }));
		const lows = outline.map(({ rests }) => new Float32Array(rests.length).fill(Number.POSITIVE_INFINITY));
		for (let step = 0; step <= this.#steps; step++) {
			pose((duration * step) / this.#steps);
			from.makeEmpty();
			outline.forEach(({ vertices }, n) => {
				const places = vertices.update();
				const low = lows[n] as Float32Array;
				for (let i = 0; i < low.length; i++) {
					from.expandByPoint(place.fromArray(places, 3 * i));
					low[i] = Math.min(low[i] as number, place.y);
				}
			});
			from.min.toArray(this.#boxes, 6 * step);
			from.max.toArray(this.#boxes, 6 * step + 3);
			this.box.union(from);
			for (const { vertices } of outline) measure(vertices.places, far);
		}
		const centre = this.box.getCenter(place);
		const radius = Math.max(...far.map((outer) => outer.place.distanceTo(centre)));
		const near = rest && differ(this.box, rest.box) < SLACK * rest.radius;
		this.radius = near ? rest.radius : radius;
		if (near) this.box.copy(rest.box);
		this.low = outline
			.flatMap(({ rests }, n) => rests.map((rest, i) => ({ rest, height: lows[n]?.[i] as number })))
			.sort((a, b) => a.height - b.height);
	}

	/** Box around the body at a moment. @param time seconds into the clip */
	boxAt(time: number, target: Box3): Box3 {
		const at = this.#duration > 0 ? Math.min((time / this.#duration) * this.#steps, this.#steps) : 0;
		const step = Math.min(Math.floor(at), this.#steps - 1);
		this.#boxOf(step, from);
		this.#boxOf(step + 1, to);
		target.min.lerpVectors(from.min, to.min, at - step);
		target.max.lerpVectors(from.max, to.max, at - step);
		return target;
	}

	#boxOf(step: number, target: Box3): void {
		target.min.fromArray(this.#boxes, 6 * step);
		target.max.fromArray(this.#boxes, 6 * step + 3);
	}
}

/** Largest difference between the sides of two boxes. */
function differ(one: Box3, other: Box3): number {
	return Math.max(
		...[place.subVectors(one.min, other.min), from.min.subVectors(one.max, other.max)].flatMap((side) =>
			side.toArray().map(Math.abs),
		),
	);
}

/** Keeps the outermost places. */
function measure(places: Float32Array, far: readonly { reach: number; place: Vector3 }[]): void {
	for (let i = 0; i < places.length; i += 3) {
		place.fromArray(places, i);
		for (let d = 0; d < far.length; d++) {
			const outer = far[d] as { reach: number; place: Vector3 };
			const reach = place.dot(DIRECTIONS[d] as Vector3);
			if (reach <= outer.reach) continue;
			outer.reach = reach;
			outer.place.copy(place);
		}
	}
}
