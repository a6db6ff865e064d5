import { type BufferAttribute, type BufferGeometry, type InterleavedBufferAttribute, Vector3 } from 'three';

/** Faces on both sides of an edge of a surface, whichever copies of its ends they have. */
interface Sides {
	/** Vertices at its ends, as the first of its faces goes round it. */
	from: number;
	to: number;
	/** First corner of that face. */
	one: number;
	/** The same of the other face; of the first where there is none. */
	two: number;
	/** Point of the first face that is not on the edge. */
	apex: number;
}

/** Normals of the faces beside the edges of a surface whose patches overlap. */
export class EdgeFaces {
	readonly #position: BufferAttribute | InterleavedBufferAttribute;
	/** Point of each vertex: copies have one. */
	readonly #points: Uint32Array;
	readonly #corners: ArrayLike<number>;
	readonly #sides = new Map<number, Sides>();
	readonly #spare = [new Vector3(), new Vector3()] as const;

	constructor(surface: BufferGeometry) {
		const position = surface.getAttribute('position');
		const found = new Map<string, number>();
		this.#position = position;
		this.#points = Uint32Array.from({ length: position.count }, (_, i) => {
			const key = `${position.getX(i)},${position.getY(i)},${position.getZ(i)}`;
			const point = found.get(key) ?? found.size;
			if (point === found.size) found.set(key, point);
			return point;
		});
		this.#corners = surface.index?.array ?? this.#points.map((_, i) => i);
		for (let face = 0; face + 2 < this.#corners.length; face += 3) this.#add(face);
	}

	/** Edges, each once, in the order in which faces bring them: a face is gone round from its lowest vertex. */
	get edges(): Iterable<Readonly<Sides>> {
		return this.#sides.values();
	}

	/** Number of edges. */
	get count(): number {
		return this.#sides.size;
	}

	/** Takes the three edges of a face. */
	#add(face: number): void {
		const corners = [this.#vertex(face), this.#vertex(face + 1), this.#vertex(face + 2)];
		const lowest = corners.indexOf(Math.min(...corners));
		for (let c = lowest; c < lowest + 3; c++) {
			const [from, to, third] = [corners[c % 3], corners[(c + 1) % 3], corners[(c + 2) % 3]] as [
				number,
				number,
				number,
			];
			const key = this.#key(from, to);
			const apex = this.#points[third] as number;
			const known = this.#sides.get(key);
			if (!known) this.#sides.set(key, { from, to, one: face, two: face, apex });
			// A face with the same third point is a copy in another patch.
			else if (known.two === known.one && known.apex !== apex) known.two = face;
		}
	}

	/** Puts the unit normals of an edge's faces into `one` and `two`: the same on both sides of a border. */
	normals(edge: Readonly<Sides>, one: Vector3, two: Vector3): void {
		this.#normal(edge.one, one);
		this.#normal(edge.two, two);
	}

	#vertex(corner: number): number {
		return this.#corners[corner] as number;
	}

	#key(from: number, to: number): number {
		const [a, b] = [this.#points[from] as number, this.#points[to] as number];
		return Math.min(a, b) * this.#points.length + Math.max(a, b);
	}

	#normal(face: number, normal: Vector3): void {
		const [side, origin] = this.#spare;
		origin.fromBufferAttribute(this.#position, this.#vertex(face));
		side.fromBufferAttribute(this.#position, this.#vertex(face + 2)).sub(origin);
		normal
			.fromBufferAttribute(this.#position, this.#vertex(face + 1))
			.sub(origin)
			.cross(side)
			.normalize();
	}
}
