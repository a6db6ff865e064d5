/** Settings of a fur, taken over by another one. */

import { Color } from 'three';
import type { FurFins } from './FurFins.ts';
import type { FurMaterial } from './FurMaterial.ts';
import type { FurShells } from './FurShells.ts';

/** Settings of the light. */
const LIGHT = [
	'gloss',
	'sharpness',
	'backlight',
	'glow',
	'contrast',
	'environment',
	'lampsPerFragment',
	'multisampled',
] as const;
/** Settings of the hairs of one pelt. */
const HAIRS = ['density', 'tipShare', 'rampPower', 'bodyRadius'] as const;
const COLOURS = ['skinColor', 'root', 'tip', 'tip2'] as const;
const FINS = ['finLength', 'finOpacity'] as const;

/** Fur whose look is copied. */
interface Looking {
	readonly material: FurMaterial;
	readonly shells: FurShells;
	readonly fins: FurFins | undefined;
	length: number;
}

/** Copies settings of the light to another material. */
export function copyLight(from: FurMaterial, to: FurMaterial): void {
	Object.assign(to, Object.fromEntries(LIGHT.map((name) => [name, from[name]])));
}

/** Copies all settings to another fur of the same pelt. */
export function copyLook(from: Looking, to: Looking): void {
	copyLight(from.material, to.material);
	Object.assign(to.material, Object.fromEntries(HAIRS.map((name) => [name, from.material[name]])));
	for (const name of COLOURS) to.material[name] = new Color().copy(from.material[name]);
	to.length = from.length;
	const { automatic, coarseness, merging, shellCount, castShadow, receiveShadow } = from.shells;
	Object.assign(to.shells, { coarseness, merging, castShadow, receiveShadow });
	if (!automatic) to.shells.shellCount = shellCount;
	if (!from.fins || !to.fins) return;
	to.fins.visible = from.fins.visible;
	to.fins.receiveShadow = from.fins.receiveShadow;
	for (const name of FINS) to.fins.material[name] = from.fins.material[name];
}
