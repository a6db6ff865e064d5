/** Who gets finer planes: a preset's own, fetched and shown after the first fur. */

export const planes = ['64', '128', 'auto'] as const;

/** Texels per side of a slab, or what suits the device. */
export type Planes = (typeof planes)[number];

export const isPlanes = (text: string): text is Planes => (planes as readonly string[]).includes(text);

/** CSS pixels of a screen's shorter side, and gigabytes of memory, below which finer planes are not worth their bytes. */
const SMALL = 600;
const LITTLE = 4;

/** What a browser tells of its device. */
export interface Device {
	/** Whether the main pointer is a finger. */
	coarse: boolean;
	/** Of the screen's shorter side, CSS pixels. */
	side: number;
	/** Gigabytes; undefined where it is not told. */
	memory: number | undefined;
	/** Whether the visitor wants to save data. */
	saving: boolean;
}

/** What can be told of this one. */
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

/** @returns whether finer planes are to be fetched */
export function wantsFine(asked: Planes = 'auto', device: () => Device = thisDevice): boolean {
	if (asked !== 'auto') return asked === '128';
	const { coarse, side, memory = LITTLE, saving } = device();
	return !saving && !coarse && side >= SMALL && memory >= LITTLE;
}
