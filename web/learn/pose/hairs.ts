/** Hairs of a limb of two bones: roots and tips, each carried by both bones as its weight says. */

import { random } from '../../page/random.ts';
import type { Frame, Vector } from './frame.ts';

/** Units are half a limb's length; the joint is at the origin, the limb lies along x and comes from beyond the picture. */
const [LEFT, RIGHT] = [-2, 1.5];
const HAIRS = 3800;
/** Half of the bend: share of the turn grows from 0 to 1 from one side of the joint to the other. */
const BEND = 0.34;
/** Length of a hair, its lean along the limb, and disorder. */
const [LONG, LEAN, DISORDER] = [0.25, 0.75, 0.3];

/** Place of the watched vertex along the forearm. */
export const WATCHED = 0.85;

/** Radius of the limb at a place along it: thick at the shoulder, thin before the paw. */
export function radiusAt(along: number): number {
	const taper = 0.29 - 0.06 * Math.max(along + 1, -0.4);
	const paw = 0.075 * Math.exp(-(((along - RIGHT + 0.16) / 0.2) ** 2));
	const end = Math.min((RIGHT - along) / 0.2, 1);
	return (taper + paw) * Math.sqrt(Math.max(1 - (1 - Math.max(end, 0)) ** 2, 0));
}

/** Share of the joint's turn that a place along the limb takes, 0..1. */
export function weightAt(along: number): number {
	const t = Math.min(Math.max((along + BEND) / (2 * BEND), 0), 1);
	return t * t * (3 - 2 * t);
}

/** Linear blend of a point and the same point turned. */
function carried([x, y, z]: Vector, weight: number, cos: number, sin: number): Vector {
	return [(1 - weight) * x + weight * (cos * x - sin * y), (1 - weight) * y + weight * (sin * x + cos * y), z];
}

const unit = ([x, y, z]: Vector): Vector => {
	const length = Math.hypot(x, y, z) || 1;
	return [x / length, y / length, z / length];
};
const cross = (a: Vector, b: Vector): Vector => [
	a[1] * b[2] - a[2] * b[1],
	a[2] * b[0] - a[0] * b[2],
	a[0] * b[1] - a[1] * b[0],
];

/** A hair on the limb at rest. */
interface Rest {
	along: number;
	root: Vector;
	normal: Vector;
	/** towards its tip, in the frame of its root: along T, B and N */
	tip: Vector;
	shade: number;
}

/** A hair in a pose. */
export interface Hair {
	root: Vector;
	tip: Vector;
	frame: Frame;
	/** its own brightness, a factor */
	shade: number;
}

export class Hairs {
	/** Hairs from the back to the front, as a turn about z leaves them. */
	readonly #rest: readonly Rest[];

	constructor(seed = 11) {
		const next = random(seed);
		const off = () => DISORDER * (next() - 0.5);
		this.#rest = Array.from({ length: HAIRS }, () => {
			const along = LEFT + (RIGHT - LEFT - 0.01) * next();
			// None that the limb hides.
			const angle = Math.PI * (1.24 * next() - 0.62);
			const normal: Vector = [0, Math.sin(angle), Math.cos(angle)];
			const radius = radiusAt(along);
			const root: Vector = [along, radius * normal[1], radius * normal[2]];
			const long = LONG * (0.75 + 0.4 * next()) * Math.min(1, 0.45 + radius * 2);
			const tip: Vector = [long * (LEAN + off()), long * off(), long * (1 - 0.4 * LEAN + off())];
			return { along, root, normal, tip, shade: 0.82 + 0.36 * next() };
		}).sort((a, b) => a.root[2] - b.root[2]);
	}

	/** Calls back with each hair in the pose, from the back to the front. @param angle of the joint, radians */
	pose(angle: number, draw: (hair: Hair) => void): void {
		const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
		for (const { along, root, normal, tip, shade } of this.#rest) {
			const weight = weightAt(along);
			const at = carried(root, weight, cos, sin);
			const up = unit(carried(normal, weight, cos, sin));
			const tangent = unit(carried([1, 0, 0], weight, cos, sin));
			const frame: Frame = { tangent, bitangent: cross(up, tangent), normal: up };
			const end = [0, 1, 2].map(
				(c) =>
					(at[c] as number) +
					tip[0] * (tangent[c] as number) +
					tip[1] * (frame.bitangent[c] as number) +
					tip[2] * (up[c] as number),
			) as unknown as Vector;
			draw({ root: at, tip: end, frame, shade });
		}
	}

	/** Outline of the bare limb in a pose. */
	static outline(angle: number): [number, number][] {
		const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
		const steps = Array.from({ length: 61 }, (_, i) => LEFT + ((RIGHT - LEFT) * i) / 60);
		const side = (sign: number) =>
			steps.map((along): [number, number] => {
				const [x, y] = carried([along, sign * radiusAt(along), 0], weightAt(along), cos, sin);
				return [x, y];
			});
		return [...side(1), ...side(-1).reverse()];
	}
}

/** Place of the watched vertex, on the upper side of the forearm. */
export function watchedAt(angle: number): Vector {
	return carried([WATCHED, radiusAt(WATCHED), 0], weightAt(WATCHED), Math.cos(angle), Math.sin(angle));
}
