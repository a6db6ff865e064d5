/** A furry limb: a tube along x with a shoulder at its beginning and an elbow in its middle. */

import {
	Bone,
	type BufferGeometry,
	CylinderGeometry,
	Float32BufferAttribute,
	Matrix4,
	Skeleton,
	SkinnedMesh,
	Uint16BufferAttribute,
	Vector3,
} from 'three';
import { type Body, bodyOf } from '../furs.ts';

export const RADIUS = 0.2;
/** Longest fur, model units. */
export const LENGTH = 0.3;
/** Units of the mesh per model unit, as of a file with quantised positions. */
const UNITS = 40;

export interface Limb extends Body {
	readonly shoulder: Bone;
	readonly elbow: Bone;
	readonly mesh: SkinnedMesh;
}

/** Share of the elbow at a place along the limb. */
const bend = (x: number) => Math.min(Math.max(x - 0.5, 0), 1);

/** @param hold share of the elbow at a place along the limb, 0 to 2 */
export function limb(hold = bend): Limb {
	const geometry: BufferGeometry = new CylinderGeometry(RADIUS, RADIUS, 2, 12, 10, true);
	geometry.rotateZ(-Math.PI / 2).translate(1, 0, 0);
	const position = geometry.getAttribute('position');
	const normal = geometry.getAttribute('normal');
	const each = Array.from({ length: position.count }, (_, i) => i);
	const comb = each.flatMap((i) => [0, 0.1 * normal.getZ(i), -0.1 * normal.getY(i)]);
	geometry.setAttribute('_comb', new Float32BufferAttribute(comb, 3));
	const weights = each.flatMap((i) => [1 - hold(position.getX(i)), hold(position.getX(i)), 0, 0]);
	const joints = each.flatMap(() => [0, 1, 0, 0]);
	geometry.setAttribute('skinIndex', new Uint16BufferAttribute(joints, 4));
	geometry.setAttribute('skinWeight', new Float32BufferAttribute(weights, 4));
	geometry.scale(UNITS, UNITS, UNITS);
	const mesh = new SkinnedMesh(geometry);
	const body = bodyOf(geometry, LENGTH, 1 / UNITS, mesh);
	const [shoulder, elbow] = [new Bone(), new Bone()];
	elbow.position.x = 1;
	body.place.add(shoulder.add(elbow));
	const smaller = new Matrix4().makeScale(1 / UNITS, 1 / UNITS, 1 / UNITS);
	const inverses = [smaller, new Matrix4().makeTranslation(-1, 0, 0).multiply(smaller)];
	mesh.bind(new Skeleton([shoulder, elbow], inverses), new Matrix4());
	return { ...body, shoulder, elbow, mesh };
}

/** Where the limb's skin is, by three's own sums. @param rest place along, up and aside, model units */
export function skinned({ place, shoulder, elbow }: Limb, rest: Vector3, share = bend(rest.x)): Vector3 {
	place.updateMatrixWorld();
	const by = (bone: Bone, x: number) =>
		rest
			.clone()
			.sub(new Vector3(x, 0, 0))
			.applyMatrix4(bone.matrixWorld);
	return by(shoulder, 0).lerp(by(elbow, 1), share);
}

/** Follicle nearest to a place, model units. */
export function follicleAt({ fur }: Body, place: Vector3): number {
	const { count, position } = fur.follicles;
	const away = Array.from({ length: count }, (_, i) =>
		new Vector3()
			.fromArray(position, 3 * i)
			.divideScalar(UNITS)
			.distanceTo(place),
	);
	return away.indexOf(Math.min(...away));
}

/** Rest of a follicle, model units, and its normal. */
export function rootOf({ fur }: Body, i: number): { at: Vector3; normal: Vector3 } {
	const { position, normal } = fur.follicles;
	return {
		at: new Vector3().fromArray(position, 3 * i).divideScalar(UNITS),
		normal: new Vector3().fromArray(normal, 3 * i),
	};
}
