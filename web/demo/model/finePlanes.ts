/** Finer planes, a preset's own: which devices fetch them after the first fur. */

import type { Planes } from '../state/view.ts';

/** Shorter side of the screen in CSS pixels, and memory in gigabytes, from which finer planes are worth their bytes. */
const MIN_SCREEN_SIDE = 600;
const MIN_MEMORY = 4;

/** Properties of a device, as far as the browser has them. */
export interface Device {
	/** True if the main pointer is a finger. */
	coarse: boolean;
	/** Shorter side of the screen, CSS pixels. */
	side: number;
	/** Gigabytes; undefined in browsers that keep it. */
	memory: number | undefined;
	/** True if the visitor wants to save data. */
	saving: boolean;
}

/** Properties of this device. */
export function thisDevice(): Device {
	const { deviceMemory, connection } = navigator as Navigator & {
		deviceMemory?: number;
		connection?: { saveData?: boolean };
	};
	return {
		coarse: matchMedia('(pointer: coarse)').matches,
		side: Math.min(screen.width, screen.height),
		memory: deviceMemory,
		saving: connection?.saveData === true || matchMedia('(prefers-reduced-data: reduce)').matches,
	};
}

/** @returns true if finer planes are to be fetched */
export function wantsFine(asked: Planes = 'auto', device: () => Device = thisDevice): boolean {
	if (asked !== 'auto') return asked === '128';
	const { coarse, side, memory = MIN_MEMORY, saving } = device();
	return !saving && !coarse && side >= MIN_SCREEN_SIDE && memory >= MIN_MEMORY;
}
