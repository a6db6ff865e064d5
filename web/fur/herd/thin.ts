/** Thin parts of a body in a herd, such as whiskers, which would fall into dots where they are narrower than a pixel. */

import {
	Box3,
	BufferAttribute,
	type BufferGeometry,
	type IUniform,
	type Material,
	type Mesh,
	Vector3,
	type WebGLProgramParametersWithUniforms,
} from 'three';
import thinning from '../shaders/skin/thin.vert.glsl?raw';

/** Width over length below which a part is thin. */
const THIN = 0.1;
/** Widths in pixels at which a thin part is gone, and up to which it is shorter than it was made. */
const [GONE, WHOLE] = [0.2, 0.8];

const DECLARED = /* glsl */ `#include <common>
attribute vec4 spine; // nearest point on the part's long axis; half of its width in the middle, 0 for a part that is not thin
attribute vec3 spineRoot; // end of that axis at the body
uniform float pictureHeight; // pixels
#define THIN_GONE ${GONE}
#define THIN_WHOLE ${WHOLE}`;

/** Vertices of each mesh, which lie in a geometry one mesh after the other, and the first one's place. */
function partsOf(positions: BufferAttribute, meshes: readonly Mesh[]): { first: number; points: Vector3[] }[] {
	let end = 0;
	return meshes.map(({ geometry }) => {
		const { count } = geometry.getAttribute('position');
		const first = end;
		end += count;
		return {
			first,
			points: Array.from({ length: count }, (_, i) => new Vector3().fromBufferAttribute(positions, first + i)),
		};
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

/** Gives a geometry that several meshes are merged in the axes of those that are thin. @returns whether there are any */
export function markThin(geometry: BufferGeometry, meshes: readonly Mesh[]): boolean {
	const positions = geometry.getAttribute('position') as BufferAttribute;
	const parts = partsOf(positions, meshes).map((part) => ({ ...part, ...axisOf(part.points) }));
	const thin = parts.filter(({ width, length }) => width < THIN * length);
	if (thin.length === 0) return false;
	const others = parts.filter((part) => !thin.includes(part));
	const body = middleOf((others.length ? others : parts).flatMap(({ points }) => points));
	const spines = new Float32Array(4 * positions.count);
	const roots = new Float32Array(3 * positions.count);
	for (const { first, points, middle, axis, length, width } of thin) {
		const inwards = Math.sign(body.clone().sub(middle).dot(axis)) || 1;
		const root = middle.clone().addScaledVector(axis, inwards * length);
		for (const [i, point] of points.entries()) {
			const along = point.clone().sub(middle).dot(axis);
			const vertex = first + i;
			spines.set([...middle.clone().addScaledVector(axis, along), width], 4 * vertex);
			root.toArray(roots, 3 * vertex);
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
}
