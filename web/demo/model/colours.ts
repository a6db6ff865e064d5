/**
 * Colours of root and tip as a visitor picks and sees them, sRGB rrggbb. The hairs' own are paler: light darkens on its way
 * through many of them.
 */

import { Color } from 'three';
import { type Fur, FurColors } from '../../fur/index.ts';

/** Largest factor of a tint's channel, on fur whose hairs each have a colour. */
const MAX_TINT = 4;

/** Colours that the fur was baked with. */
interface Baked {
	root: Color;
	tip: Color;
	tip2: Color;
	skinColor: Color;
	/** Conversion of hairs' colours to seen ones; undefined: none. */
	seen: FurColors | undefined;
}

const bakedByFur = new WeakMap<Fur, Baked>();

function baked(fur: Fur): Baked {
	const { root, tip, tip2, skinColor } = fur.shells.material;
	let colours = bakedByFur.get(fur);
	if (!colours) {
		colours = {
			...{ root: root.clone(), tip: tip.clone(), tip2: tip2.clone(), skinColor: skinColor.clone() },
			seen: FurColors.of(fur.asset),
		};
		bakedByFur.set(fur, colours);
	}
	return colours;
}

/** True if every hair has its own colour: the tip's colour tints all then, and the root's does nothing. */
export function hasOwnColours(fur: Fur): boolean {
	return fur.textures.colour !== undefined && fur.textures.colour !== null;
}

const hex = (colour: Color) => {
	const { r, g, b } = colour;
	return new Color(Math.min(r, 1), Math.min(g, 1), Math.min(b, 1)).getHexString();
};

/** Seen colour of hairs. */
function asSeen({ seen }: Baked, { r, g, b }: Color): Color {
	return seen ? new Color(seen.seen(r), seen.seen(g), seen.seen(b)) : new Color(r, g, b);
}

/** Colour of hairs that are seen in the given one. */
function asHairs({ seen }: Baked, { r, g, b }: Color): Color {
	return seen ? new Color(seen.hairs(r), seen.hairs(g), seen.hairs(b)) : new Color(r, g, b);
}

/** Colours of root and tip as baked. */
export function bakedColours(fur: Fur): [root: string, tip: string] {
	const own = baked(fur);
	return [hex(asSeen(own, own.root)), hex(asSeen(own, own.tip))];
}

/** Ratio of two colours per channel. */
function ratio(to: Color, from: Color): Color {
	const share = (a: number, b: number) => Math.min(a / Math.max(b, 1e-3), MAX_TINT);
	return new Color(share(to.r, from.r), share(to.g, from.g), share(to.b, from.b));
}

/** @param colours of root and tip; undefined: as baked */
export function paint(fur: Fur, colours: readonly [root: string, tip: string] | undefined): void {
	const own = baked(fur);
	const { root, tip, tip2, skinColor } = fur.shells.material;
	root.copy(own.root);
	tip.copy(own.tip);
	tip2.copy(own.tip2);
	skinColor.copy(own.skinColor);
	if (!colours) return;
	const wanted = new Color(`#${colours[1]}`);
	if (hasOwnColours(fur)) {
		skinColor.multiply(ratio(asHairs(own, wanted), own.tip));
		return;
	}
	root.copy(asHairs(own, new Color(`#${colours[0]}`)));
	tip.copy(asHairs(own, wanted));
	// Second tips, of the belly say, keep their ratio to the first.
	const other = asSeen(own, own.tip2).multiply(ratio(wanted, asSeen(own, own.tip)));
	tip2.copy(asHairs(own, other.setRGB(Math.min(other.r, 1), Math.min(other.g, 1), Math.min(other.b, 1))));
}
