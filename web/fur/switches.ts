/** Parts of shaders that are compiled in only where there is something to be seen of them: a define each. */

import type { ShaderMaterial } from 'three';

/** What changes where hairs are and how much they cover, whatever lights them. */
export const SHAPE = ['DENSITY', 'SWING', 'TRIMMED', 'WET', 'DIRTY', 'MUD'] as const;

/**
 * Has a part compiled in or left out. The renderer keeps the programs of a material: to switch back and forth is cheap.
 *
 * @param value of its define; undefined: left out
 */
export function switchPart(material: ShaderMaterial, part: string, value: string | number | undefined): void {
	if (material.defines[part] === value) return;
	if (value !== undefined) material.defines[part] = value;
	else delete material.defines[part];
	material.needsUpdate = true;
}

/** Has the same of these parts compiled in as another material. */
export function followParts(material: ShaderMaterial, leader: ShaderMaterial, parts: readonly string[]): void {
	for (const part of parts) switchPart(material, part, leader.defines[part] as string | number | undefined);
}

/** Has uniforms of a material be properties of it, too. */
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
