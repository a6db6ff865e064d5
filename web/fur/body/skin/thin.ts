/** Thin parts of a body, such as whiskers, which would fall into dots where they are narrower than a pixel. */

import {
	Box3,
	BufferAttribute,
	type BufferGeometry,
	type IUniform,
	type Material,
	Matrix4,
	type Mesh,
	type Object3D,
	SkinnedMesh,
	Vector3,
	Vector4,
	type WebGLProgramParametersWithUniforms,
} from 'three';
import thinning from '../../shaders/skin/thin.vert.glsl?raw';

/** Width over length below which a part is thin. */
const THIN = 0.1;
/** Widths in pixels at which a thin part is gone, and up to which it is shorter than it was made. */
const [GONE, WHOLE] = [0.2, 0.8];
/** Half of the least width in pixels: a part of few sides is narrower than it is round. */
const LEAST = 0.6;

/** Materials of `keepThin`. */
const kept = new WeakSet<Material>();

const DECLARED = /* glsl */ `#include <common>
attribute vec4 spine; // nearest point on the part's long axis; half of its width in the middle, 0 for a part that is not thin
attribute vec3 spineRoot; // end of that axis at the body
uniform float pictureHeight; // pixels
#define THIN_LEAST ${LEAST}
#define THIN_GONE ${GONE}
#define THIN_WHOLE ${WHOLE}`;

/** Vertices of each mesh, which lie in a geometry one mesh after the other, and the first one's place. */
function partsOf(
	positions: BufferAttribute,
	meshes: readonly Mesh[],
	placement: Matrix4,
): { first: number; points: Vector3[] }[] {
	let end = 0;
	return meshes.map(({ geometry }) => {
		const { count } = geometry.getAttribute('position');
		const first = end;
		end += count;
		const point = (_: unknown, i: number) =>
			new Vector3().fromBufferAttribute(positions, first + i).applyMatrix4(placement);
		return { first, points: Array.from({ length: count }, point) };
	});
}

const middleOf = (points: readonly Vector3[]): Vector3 =>
	new Box3().setFromPoints([...points]).getCenter(new Vector3());

/** Middle, unit axis, half length and half width of a part. */
function axisOf(points: readonly Vector3[]): { middle: Vector3; axis: Vector3; length: number; width: number } {
	const middle = middleOf(points);
	const axis = points.reduce((far, point) => {
		const from = point.clone().sub(middle);
		return from.lengthSq() > far.lengthSq() ? from : far;
	}, new Vector3());
	const length = axis.length();
	axis.normalize();
	const asides = points.map((point) => point.clone().sub(middle).projectOnPlane(axis).length());
	return { middle, axis, length, width: Math.max(...asides) };
}

/**
 * Gives a geometry that several meshes are merged in the axes of those that are thin.
 *
 * @param placement the geometry's axes → those in which widths and lengths are compared
 * @param body middle of what the thin parts are on, in the latter axes; by default that of the other meshes
 * @returns whether there are any
 */
export function markThin(
	geometry: BufferGeometry,
	meshes: readonly Mesh[],
	placement = new Matrix4(),
	body?: Vector3,
): boolean {
	const positions = geometry.getAttribute('position') as BufferAttribute;
	const parts = partsOf(positions, meshes, placement).map((part) => ({ ...part, ...axisOf(part.points) }));
	const thin = parts.filter(({ width, length }) => width < THIN * length);
	if (thin.length === 0) return false;
	const others = parts.filter((part) => !thin.includes(part));
	const on = body ?? middleOf((others.length ? others : parts).flatMap(({ points }) => points));
	const back = placement.clone().invert();
	const spines = new Float32Array(4 * positions.count);
	const roots = new Float32Array(3 * positions.count);
	const vertex = new Vector3();
	for (const { first, points, middle, axis, length } of thin) {
		const inwards = Math.sign(on.clone().sub(middle).dot(axis)) || 1;
		const root = middle
			.clone()
			.addScaledVector(axis, inwards * length)
			.applyMatrix4(back);
		const spine = points.map((point) =>
			middle.clone().addScaledVector(axis, point.clone().sub(middle).dot(axis)).applyMatrix4(back),
		);
		const asides = spine.map((point, i) => vertex.fromBufferAttribute(positions, first + i).distanceTo(point));
		const width = asides.reduce((most, aside) => Math.max(most, aside), 0);
		for (const [i, point] of spine.entries()) {
			spines.set([...point, width], 4 * (first + i));
			root.toArray(roots, 3 * (first + i));
		}
	}
	geometry.setAttribute('spine', new BufferAttribute(spines, 4));
	geometry.setAttribute('spineRoot', new BufferAttribute(roots, 3));
	return true;
}

/** Makes a material keep the thin parts of a geometry of `markThin` in sight. @param height of the picture, pixels */
export function keepThin(material: Material, height: IUniform<number>): void {
	const before = material.onBeforeCompile;
	const key = material.customProgramCacheKey();
	material.onBeforeCompile = (shader: WebGLProgramParametersWithUniforms, renderer) => {
		before.call(material, shader, renderer);
		shader.uniforms.pictureHeight = height;
		shader.vertexShader = shader.vertexShader
			.replace('#include <common>', DECLARED)
			.replace('#include <begin_vertex>', (include) => `${include}\n${thinning}`);
	};
	material.customProgramCacheKey = () => `${key} thin`;
	kept.add(material);
}

/** Whether a material has no hook but that of `keepThin`. */
export const isKeptThin = (material: Material): boolean => kept.has(material);

const viewport = new Vector4();

/**
 * Keeps the thin parts of one body in sight where they are narrower than a pixel, such as whiskers: they are a pixel wide at
 * least, and shorter the less of it they cover. `FurInstances` does so by itself.
 *
 * @param root of the body, in the size in which it is shown
 * @param parts of it that are looked at, such as what stands between its hairs; those that joints bend stay as they are
 */
export function keepThinFurParts(root: Object3D, parts: readonly Mesh[]): void {
	root.updateWorldMatrix(true, true);
	const body = new Box3().setFromObject(root).getCenter(new Vector3());
	const height = { value: 1 };
	const copies = new Map<Material, Material>();
	for (const part of parts) {
		const { geometry, material } = part;
		// A copy would lose what an application does to its shader.
		if (part instanceof SkinnedMesh || Array.isArray(material) || Object.hasOwn(material, 'onBeforeCompile')) continue;
		if (!markThin(geometry, [part], part.matrixWorld, body)) continue;
		const copy = copies.get(material) ?? material.clone();
		copies.set(material, copy);
		part.material = copy;
	}
	for (const copy of copies.values()) {
		keepThin(copy, height);
		copy.onBeforeRender = (renderer) => {
			height.value = renderer.getCurrentViewport(viewport).w;
		};
	}
}
