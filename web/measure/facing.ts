/** Where a body's face is: told by its eyes, else by its symmetry; glTF itself says +z. */

import { Box3, type BufferAttribute, type BufferGeometry, Mesh, type Object3D, Vector3 } from 'three';

/** Name of an eye: a word of its own, or one in a name in camel case. */
const EYE = /(^|[^a-z])eyes?([^a-z]|$)|Eye/;
/** Variance across two eyes over that along them: less is a single eye. */
const APART = 4;
/** Cells per side of the grid in which a body is compared with its mirror image. */
const CELLS = 20;
/** Excess of one symmetry over the other that tells sides from front and back. */
const CLEAR = 0.1;

const vertex = new Vector3();

/** All vertices of a mesh, world axes, in the present pose. */
function* verticesOf(mesh: Mesh): Generator<Vector3> {
	const { position } = (mesh.geometry as BufferGeometry<{ position: BufferAttribute }>).attributes;
	for (let i = 0; i < position.count; i++) yield mesh.getVertexPosition(i, vertex).applyMatrix4(mesh.matrixWorld);
}

/**
 * Azimuth of a body's face about the upright axis, radians from +z towards +x.
 *
 * @param root with all parts of the body
 * @param skin of the body, or its parent
 */
export function facing(root: Object3D, skin: Object3D): number {
	root.updateWorldMatrix(true, true);
	const [eyes, body]: [Vector3[], Vector3[]] = [[], []];
	root.traverse((part) => {
		if (part instanceof Mesh && (EYE.test(part.name) || EYE.test(part.parent?.name ?? '')))
			for (const place of verticesOf(part)) eyes.push(place.clone());
	});
	skin.traverse((part) => {
		if (part instanceof Mesh && part.visible) for (const place of verticesOf(part)) body.push(place.clone());
	});
	if (body.length === 0) return 0;
	return (eyes.length > 0 ? byEyes(eyes, middleOf(body)) : bySymmetry(body)) ?? 0;
}

/** Across the line between the eyes, away from the body's middle. */
function byEyes(eyes: readonly Vector3[], middle: Vector3): number | undefined {
	const mean = eyes.reduce((sum, eye) => sum.add(eye), new Vector3()).divideScalar(eyes.length);
	let [xx, xz, zz] = [0, 0, 0];
	for (const { x, z } of eyes) {
		xx += (x - mean.x) ** 2;
		xz += (x - mean.x) * (z - mean.z);
		zz += (z - mean.z) ** 2;
	}
	const [away, side] = [mean.clone().sub(middle), Math.hypot((xx - zz) / 2, xz)];
	if ((xx + zz) / 2 + side < APART * ((xx + zz) / 2 - side)) return Math.atan2(away.x, away.z);
	// Angle of the line between them from +x towards +z; the face is a quarter turn from it.
	const across = Math.atan2(2 * xz, xx - zz) / 2;
	const front = new Vector3(-Math.sin(across), 0, Math.cos(across));
	if (front.dot(away) < 0) front.negate();
	return Math.atan2(front.x, front.z);
}

/** Along x, to the end that is higher, where left and right are along z. */
function bySymmetry(body: Vector3[]): number | undefined {
	const middle = middleOf(body);
	const reach = body.reduce((most, place) => Math.max(most, vertex.subVectors(place, middle).length()), 0) || 1;
	const cell = ({ x, y, z }: Vector3, mirrorX: number, mirrorZ: number) =>
		[mirrorX * (x - middle.x), y - middle.y, mirrorZ * (z - middle.z)]
			.map((part) => Math.round((part / reach) * (CELLS / 2)))
			.join();
	const own = new Set(body.map((place) => cell(place, 1, 1)));
	const alike = (mirrorX: number, mirrorZ: number) =>
		body.filter((place) => own.has(cell(place, mirrorX, mirrorZ))).length / body.length;
	if (alike(1, -1) < alike(-1, 1) + CLEAR) return undefined;
	const heights = [1, -1].map((end) => {
		const there = body.filter(({ x }) => end * (x - middle.x) > reach / 2);
		return there.reduce((sum, { y }) => sum + y, 0) / there.length;
	});
	const [right = Number.NaN, left = Number.NaN] = heights;
	return right >= left ? Math.PI / 2 : -Math.PI / 2;
}

const middleOf = (places: Vector3[]) => new Box3().setFromPoints(places).getCenter(new Vector3());
