/** Morph targets in the materials of a fur. */

import type { BufferGeometry, IUniform, ShaderMaterial } from 'three';
import type { FurPose } from '../../body/FurPose.ts';
import { switchPart } from '../switches.ts';

/** Uniforms of pose.glsl that belong to a geometry. */
export const morphUniforms = (): Record<'morphDeltas' | 'morphUnit', IUniform> => ({
	morphDeltas: { value: null },
	morphUnit: { value: 0 },
});

/** Uniforms of pose.glsl that all materials of a fur share. */
export const weightUniforms = (): Record<'morphCount' | 'morphs', IUniform> => ({
	morphCount: { value: 0 },
	morphs: { value: null },
});

/** Compile the targets of a geometry into its material, if it has any. */
export function setMorphs(material: ShaderMaterial, geometry: BufferGeometry, pose: FurPose | undefined): void {
	const morphs = pose?.morphsOf(geometry);
	if (!pose || !morphs) return;
	const { morphDeltas, morphUnit } = material.uniforms as ReturnType<typeof morphUniforms>;
	morphDeltas.value = morphs.texture;
	morphUnit.value = morphs.unit;
	switchPart(material, 'MORPHS', pose.slots);
}

/** Shows the present weights. @param material the shells' */
export function writeMorphs(material: ShaderMaterial, { weights }: FurPose): void {
	for (const [name, { value }] of Object.entries(weights.uniforms)) {
		const uniform = material.uniforms[name];
		if (uniform) uniform.value = value;
	}
}
