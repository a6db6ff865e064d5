/**
 * The colours of root and tip, as a visitor picks them and sees them: sRGB, rrggbb. Hairs are paler, for light that meets
 * many of them darkens on its way.
 */

import { Color } from 'three';
import { type Fur, SeenColours } from '../fur/index.ts';

/** Most that a channel of the tint multiplies the hairs' own colours by, where each hair has its own. */
const strongest = 4;

/** What the fur was baked with. */
interface Baked {
	root: Color;
	tip: Color;
	tip2: Color;
	skinColour: Color;
	/** How hairs are seen; undefined: as they are. */
	seen: SeenColours | undefined;
}

const known = new WeakMap<Fur, Baked>();

function baked(fur: Fur): Baked {
	const { root, tip, tip2, skinColour } = fur.shells.material;
	let colours = known.get(fur);
	if (!colours) {
		colours = {
			...{ root: root.clone(), tip: tip.clone(), tip2: tip2.clone(), skinColour: skinColour.clone() },
			seen: SeenColours.of(fur.asset),
		};
		known.set(fur, colours);
	}
	return colours;
}

/** Whether every hair has a colour of its own: then the tip's is a tint of all, and the root's does nothing. */
export function hasOwnColours(fur: Fur): boolean {
	return fur.textures.colour !== undefined && fur.textures.colour !== null;
}

const hex = (colour: Color) => {
	const { r, g, b } = colour;
	return new Color(Math.min(r, 1), Math.min(g, 1), Math.min(b, 1)).getHexString();
};

/** A colour of hairs as it is seen. */
function asSeen({ seen }: Baked, { r, g, b }: Color): Color {
	return seen ? new Color(seen.seen(r), seen.seen(g), seen.seen(b)) : new Color(r, g, b);
}

/** The hairs that are seen in a colour. */
function asHairs({ seen }: Baked, { r, g, b }: Color): Color {
	return seen ? new Color(seen.hairs(r), seen.hairs(g), seen.hairs(b)) : new Color(r, g, b);
}

/** Colours of root and tip as baked. */
export function bakedColours(fur: Fur): [root: string, tip: string] {
	const own = baked(fur);
	return [hex(asSeen(own, own.root)), hex(asSeen(own, own.tip))];
}

/** Channel by channel what `to` is of `from`. */
function ratio(to: Color, from: Color): Color {
	const share = (a: number, b: number) => Math.min(a / Math.max(b, 1e-3), strongest);
	return new Color(share(to.r, from.r), share(to.g, from.g), share(to.b, from.b));
}

/** @param colours of root and tip; undefined: as baked */
export function paint(fur: Fur, colours: [root: string, tip: string] | undefined): void {
	const own = baked(fur);
	const { root, tip, tip2, skinColour } = fur.shells.material;
	root.copy(own.root);
	tip.copy(own.tip);
	tip2.copy(own.tip2);
	skinColour.copy(own.skinColour);
	if (!colours) return;
	const wanted = new Color(`#${colours[1]}`);
	if (hasOwnColours(fur)) {
		skinColour.multiply(ratio(asHairs(own, wanted), own.tip));
		return;
	}
	root.copy(asHairs(own, new Color(`#${colours[0]}`)));
	tip.copy(asHairs(own, wanted));
	// The other tips, of the belly say, stay as much paler or darker as they are.
	const other = asSeen(own, own.tip2).multiply(ratio(wanted, asSeen(own, own.tip)));
	tip2.copy(asHairs(own, other.setRGB(Math.min(other.r, 1), Math.min(other.g, 1), Math.min(other.b, 1))));
}
