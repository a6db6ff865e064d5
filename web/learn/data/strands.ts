/** Hairs of one tile, from the baker: public/lesson/strands.bin. Lengths in tile widths. */

import { BufferAttribute, BufferGeometry, Color, Vector3 } from 'three';

export interface Strands {
	count: number;
	/** Points of each hair, root first. */
	points: number;
	/** u, v, z and radius of every point. */
	path: Float32Array;
	/** Brightness of each hair. */
	tint: Float32Array;
}

/** @throws Error if the file is missing or of the wrong length */
export async function loadStrands(): Promise<Strands> {
	const [record, bytes] = await Promise.all([get('lesson.json'), get('strands.bin')]);
	const { strands: count, points } = (await record.json()).strands as { strands: number; points: number };
	const buffer = await bytes.arrayBuffer();
	const wanted = count * (points * 4 + 1) * 4;
	if (buffer.byteLength !== wanted)
		throw new Error(`lesson/strands.bin: got ${buffer.byteLength} bytes, expected ${wanted}`);
	const numbers = new Float32Array(buffer);
	return { count, points, path: numbers.subarray(0, count * points * 4), tint: numbers.subarray(count * points * 4) };
}

async function get(file: string): Promise<Response> {
	const response = await fetch(`lesson/${file}`);
	if (!response.ok) throw new Error(`lesson/${file}: got status ${response.status}`);
	return response;
}

export interface Ramp {
	root: Color;
	tip: Color;
	power: number;
}

/**
 * Hairs as tubes over a tile around the origin: u along x, v against z, z up.
 *
 * @param height length of the longest hair, tile widths, where the ramp ends
 * @param keep filter by root x, z; all by default
 */
export function hairTubes(
	{ count, points, path, tint }: Strands,
	{ root, tip, power }: Ramp,
	height: number,
	{ sides = 5, thick = 1, keep = (_x: number, _z: number): boolean => true } = {},
): BufferGeometry {
	const position: number[] = [];
	const normal: number[] = [];
	const colour: number[] = [];
	const index: number[] = [];
	const at = new Vector3();
	const before = new Vector3();
	const along = new Vector3();
	const [side, other, out] = [new Vector3(), new Vector3(), new Vector3()];
	const shade = new Color();
	const point = (hair: number, i: number, target: Vector3) => {
		const start = (hair * points + Math.min(Math.max(i, 0), points - 1)) * 4;
		return target.set((path[start] ?? 0) - 0.5, path[start + 2] ?? 0, 0.5 - (path[start + 1] ?? 0));
	};
	for (let hair = 0; hair < count; hair++) {
		point(hair, 0, at);
		if (!keep(at.x, at.z)) continue;
		for (let i = 0; i < points; i++) {
			point(hair, i + 1, along)
				.sub(point(hair, i - 1, before))
				.normalize();
			side.set(1, 0, 0).addScaledVector(along, -along.x).normalize();
			other.crossVectors(along, side);
			point(hair, i, at);
			const radius = (path[(hair * points + i) * 4 + 3] ?? 0) * thick;
			shade.lerpColors(root, tip, Math.min(Math.max(at.y / height, 0), 1) ** power).multiplyScalar(tint[hair] ?? 1);
			const first = position.length / 3;
			for (let k = 0; k < sides; k++) {
				const angle = (k / sides) * 2 * Math.PI;
				out.copy(side).multiplyScalar(Math.cos(angle)).addScaledVector(other, Math.sin(angle));
				position.push(at.x + out.x * radius, at.y + out.y * radius, at.z + out.z * radius);
				normal.push(out.x, out.y, out.z);
				colour.push(shade.r, shade.g, shade.b);
				if (i === 0) continue;
				const [a, b] = [first + k, first + ((k + 1) % sides)];
				index.push(a - sides, b - sides, b, a - sides, b, a);
			}
		}
	}
	const geometry = new BufferGeometry().setIndex(index);
	for (const [name, values] of Object.entries({ position, normal, color: colour }))
		geometry.setAttribute(name, new BufferAttribute(new Float32Array(values), 3));
	return geometry;
}
