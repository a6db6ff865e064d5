/** Places of vertices as the GPU has them. */

import {
	FloatType,
	type InstancedBufferGeometry,
	type Mesh,
	NoBlending,
	OrthographicCamera,
	Points,
	Scene,
	ShaderMaterial,
	UniformsLib,
	UniformsUtils,
	type WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import type { Jointed } from '../../../web/fur/body/FurPose.ts';
import { renderFloats } from '../../../web/measure/studio.ts';
import { toBase64 } from './Stand.ts';

/** World places to which the shader of shells or fins itself moves their vertices, by hairs without a length. */
export function placesOf(
	renderer: WebGLRenderer,
	part: Mesh<InstancedBufferGeometry, ShaderMaterial>,
	reach: number,
): string {
	const { geometry, material } = part;
	const { count } = geometry.getAttribute('position');
	const [width, height] = [256, Math.ceil(count / 256)];
	// World units that the picture's depth and width hold: what is divided and multiplied by two loses nothing.
	const span = 2 ** Math.ceil(Math.log2(reach));
	const probe = new ShaderMaterial({
		glslVersion: material.glslVersion,
		lights: material.lights,
		uniforms: { ...material.uniforms, ...UniformsUtils.clone(UniformsLib.lights), furLength: { value: 0 } },
		defines: { ...material.defines },
		vertexShader: `${material.vertexShader.replace('void main()', 'void ownMain()')}
			flat out vec3 vPlace;
			void main() {
				ownMain();
				vPlace = gl_Position.xyz;
				vec2 texel = vec2(gl_VertexID % ${width}, gl_VertexID / ${width}) + 0.5;
				gl_Position = vec4(texel / vec2(${width}, ${height}) * 2.0 - 1.0, 0.0, 1.0);
				gl_PointSize = 1.0;
			}`,
		fragmentShader: 'flat in vec3 vPlace; out vec4 place; void main() { place = vec4(vPlace, 1.0); }',
		blending: NoBlending,
		depthTest: false,
		depthWrite: false,
	});
	Object.assign(probe.defaultAttributeValues, material.defaultAttributeValues);
	delete probe.defines.BODY_LIGHT;
	const points = new Points(geometry, probe);
	const { isSkinnedMesh, skeleton, bindMatrix, bindMatrixInverse } = part as typeof part & Jointed;
	Object.assign(points, { isSkinnedMesh, skeleton, bindMatrix, bindMatrixInverse, frustumCulled: false });
	points.matrixAutoUpdate = points.matrixWorldAutoUpdate = false;
	points.matrixWorld.copy(part.matrixWorld);
	const { instanceCount } = geometry;
	geometry.instanceCount = 1;
	const scene = new Scene().add(points);
	const camera = new OrthographicCamera(-span, span, span, -span, -span, span);
	const target = new WebGLRenderTarget(width, height, { type: FloatType });
	const pixels = renderFloats(renderer, scene, camera, target);
	if (instanceCount !== undefined) geometry.instanceCount = instanceCount;
	target.dispose();
	probe.dispose();
	// Depth runs away from the viewer.
	const places = Float32Array.from(
		{ length: 3 * count },
		(_, i) => span * (i % 3 === 2 ? -1 : 1) * (pixels[4 * Math.floor(i / 3) + (i % 3)] ?? Number.NaN),
	);
	return toBase64(new Uint8Array(places.buffer));
}
