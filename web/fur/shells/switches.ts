/** Parts of shaders that are compiled in on demand: a define each. */

import type { BufferGeometry, Mesh, ShaderMaterial } from 'three';

/** Parts that change position and coverage of hairs, whatever lights them. */
export const SHAPE = ['DENSITY', 'SWING', 'TRIMMED', 'WET', 'DIRTY', 'MUD', 'MORPHS'] as const;

/** Defines in a fixed order: in another one they make another program. */
export const inOrder = (defines: ShaderMaterial['defines']): ShaderMaterial['defines'] =>
	Object.fromEntries(Object.entries(defines).sort());

/**
 * Compile a part in or out. The renderer keeps a material's programs, so switching back and forth is cheap.
 *
 * @param value of its define; undefined leaves the part out
 */
export function switchPart(material: ShaderMaterial, part: string, value: string | number | undefined): void {
	if (material.defines[part] === value) return;
	const { [part]: _, ...defines } = material.defines;
	if (value !== undefined) defines[part] = value;
	material.defines = inOrder(defines);
	material.needsUpdate = true;
}

/** Leave out of the shells' shaders what only combed hairs need. */
export function followComb({ geometry, material }: Mesh<BufferGeometry, ShaderMaterial>): void {
	switchPart(material, 'STRAIGHT', geometry.hasAttribute('_comb') ? 0 : 1);
}

/** Compile in the same of these parts as another material. */
export function followParts(material: ShaderMaterial, leader: ShaderMaterial, parts: readonly string[]): void {
	for (const part of parts) switchPart(material, part, leader.defines[part] as string | number | undefined);
}

/** Mirror uniforms of a material as its properties. */
export function mirrorUniforms(material: ShaderMaterial, names: readonly string[]): void {
	for (const name of names) {
		const uniform = material.uniforms[name];
		if (!uniform) continue;
		Object.defineProperty(material, name, {
			enumerable: true,
			get: () => uniform.value,
			set: (value) => {
				uniform.value = value;
			},
		});
	}
}
