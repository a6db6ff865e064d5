/** The view: everything that the page shows by choice, one value per address parameter. Imports nothing. */

export type Triple = [number, number, number];

/** Lighting methods: those of the library, and its own with light curves fitted to this very fur (eigen). */
export const METHODS = ['ptm', 'eigen', 'lengyel', 'shadow-layers', 'unlit'] as const;
export type Method = (typeof METHODS)[number];

/** Environments, by their names in the address. */
export const ENVIRONMENTS = ['studio', 'city', 'sky', 'sunset', 'forest'] as const;
export type EnvironmentName = (typeof ENVIRONMENTS)[number];

/** Texels per side of a slab, or what suits the device. */
export const PLANES = ['64', '128', 'auto'] as const;
export type Planes = (typeof PLANES)[number];

export const LANGUAGE_NAMES = ['en', 'zh'] as const;

/** Largest values of counted things. */
export const MAX_LAMPS = 8;
export const MAX_CROWD = 400;

/** A value that is undefined is left to the page. Ranges and meanings: the table of parameters. */
export interface View {
	readonly model?: string | undefined;
	readonly preset?: string | undefined;
	readonly method?: Method | undefined;
	/** second method, and the share of the room's width where it begins, 0..1 */
	readonly split?: { readonly method: Method; readonly share: number } | undefined;
	/** unit vector from the model to the lamp, world axes */
	readonly light?: Triple | undefined;
	readonly lights?: number | undefined;
	/** azimuth -180..180 degrees, elevation -90..90 degrees, distance 0.001..10: small near a body of a large crowd */
	readonly camera?: Triple | undefined;
	/** point that the camera looks at: 0 the middle of the model's box, 1 and -1 its sides */
	readonly target?: Triple | undefined;
	readonly shells?: number | undefined;
	readonly fins?: boolean | undefined;
	readonly length?: number | undefined;
	readonly density?: number | undefined;
	/** sRGB as rrggbb */
	readonly colour?: readonly [root: string, tip: string] | undefined;
	readonly planes?: Planes | undefined;
	readonly env?: EnvironmentName | 'none' | undefined;
	readonly exposure?: number | undefined;
	readonly crowd?: number | undefined;
	/** strength 0..1; 0..360 degrees from the first camera's side by way of the right */
	readonly wind?: readonly [strength: number, direction: number] | undefined;
	readonly wet?: number | undefined;
	readonly dirt?: number | undefined;
	readonly turn?: boolean | undefined;
	/** name of the model's clip */
	readonly clip?: string | undefined;
	/** seconds at which the clip is held; undefined: it plays */
	readonly time?: number | undefined;
	/** factor of the clip's speed */
	readonly speed?: number | undefined;
	/** whether the head follows the lamp */
	readonly look?: boolean | undefined;
	readonly details?: boolean | undefined;
	readonly still: boolean;
	readonly ui: boolean;
	readonly lang?: (typeof LANGUAGE_NAMES)[number] | undefined;
}

/** The view of an empty address. */
export const FIRST_VIEW: View = { still: false, ui: true };

/** True for methods that stand for comparison; the others are the fur's own light. */
export function isRival(method: Method): boolean {
	return method !== 'ptm' && method !== 'eigen';
}
