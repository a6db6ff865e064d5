/** Where a furry body stands. */

import { Matrix4, Vector3 } from 'three';
import type { Fur } from '../fur/index.ts';
import type { LowPoint, Reach } from './clips/Reach.ts';
import type { Model } from './model.ts';

/** Share of the hairs' length that the body's weight leaves below the skin. */
const PRESSED = 0.5;

const vertex = new Vector3();
const toModel = new Matrix4();

type Body = Pick<Model, 'object' | 'fur' | 'box' | 'clips'>;

/**
 * Height of the ground below a body: hairs under its feet are pressed to half of their length. The ground below one with
 * clips stays where it is in the course of a clip, and glides while one fades into another.
 *
 * @param model as it stands in its file
 * @returns world units; the lowest point of a body without fur
 */
export function footing({ object, fur, box, clips }: Body): number {
	if (clips) return clips.faded((reach) => lowestIn(reach, object, fur));
	const position = fur?.shells.geometry.getAttribute('position');
	if (!fur || !position) return box.min.y;
	const share = fur.shells.geometry.getAttribute('_fur');
	setToModel(object, fur);
	let lowest = box.min.y;
	for (let i = 0; i < position.count; i++) {
		const { y } = vertex.fromBufferAttribute(position, i).applyMatrix4(toModel);
		lowest = Math.min(lowest, y - PRESSED * fur.shells.furLength * (share ? share.getY(i) : 1));
	}
	return lowest;
}

/** Sets `toModel`: from the units of the shells' mesh to the model's. */
function setToModel(object: Model['object'], { shells }: Pick<Fur, 'shells'>): void {
	object.updateWorldMatrix(true, true);
	toModel.copy(object.matrixWorld).invert().multiply(shells.matrixWorld);
}

interface Ground {
	fur: Fur | undefined;
	length: number;
	height: number;
}

/** The ground of each clip, for the fur that was asked for last. */
const grounds = new WeakMap<Reach, Ground>();

/** Height of the ground in the course of a clip. */
function lowestIn(reach: Reach, object: Model['object'], fur: Fur | undefined): number {
	const length = fur?.shells.furLength ?? 0;
	const known = grounds.get(reach);
	if (known?.fur === fur && known?.length === length) return known.height;
	const lowest = reach.low[0]?.height ?? 0;
	// Hairs of a higher point do not reach as low.
	const feet = fur ? reach.low.filter(({ height }) => height < lowest + PRESSED * length) : [];
	const heights = feet.map((foot) => foot.height - PRESSED * length * shareAt(foot, object, fur as Fur));
	const ground = { fur, length, height: Math.min(lowest, ...heights) };
	grounds.set(reach, ground);
	return ground.height;
}

/** Lengths of the hairs at points, shares of the longest, by the shells' geometry. */
const shares = new WeakMap<object, WeakMap<LowPoint, number>>();

/** Length of the hairs at a point, share of the longest: that of the nearest vertex. */
function shareAt(foot: LowPoint, object: Model['object'], { shells }: Fur): number {
	const { geometry } = shells;
	const known = shares.get(geometry) ?? new WeakMap<LowPoint, number>();
	shares.set(geometry, known);
	let share = known.get(foot);
	if (share !== undefined) return share;
	const [position, fur] = [geometry.getAttribute('position'), geometry.getAttribute('_fur')];
	setToModel(object, { shells });
	let nearest = Number.POSITIVE_INFINITY;
	share = 1;
	for (let i = 0; fur && i < position.count; i++) {
		const away = vertex.fromBufferAttribute(position, i).applyMatrix4(toModel).distanceToSquared(foot.rest);
		if (away >= nearest) continue;
		nearest = away;
		share = fur.getY(i);
	}
	known.set(foot, share);
	return share;
}
