/** The colours of root and tip, as a visitor picks them: sRGB, rrggbb. */

import { Color } from 'three';
import type { Fur } from '../fur/index.ts';

/** Most that a channel of the tint multiplies the hairs' own colours by, where each hair has its own. */
const strongest = 4;

/** What the fur was baked with. */
interface Baked {
	root: Color;
	tip: Color;
	tip2: Color;
	skinColour: Color;
}

const known = new WeakMap<Fur, Baked>();

function baked(fur: Fur): Baked {
	const { root, tip, tip2, skinColour } = fur.shells.material;
	let colours = known.get(fur);
	if (!colours) {
		colours = { root: root.clone(), tip: tip.clone(), tip2: tip2.clone(), skinColour: skinColour.clone() };
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

/** Colours of root and tip as baked. */
export function bakedColours(fur: Fur): [root: string, tip: string] {
	const { root, tip } = baked(fur);
	return [hex(root), hex(tip)];
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
	// The other tips, of the belly say, stay as much paler or darker as they are.
	const tint = ratio(wanted, own.tip);
	if (hasOwnColours(fur)) {
		skinColour.multiply(tint);
		return;
	}
	root.set(`#${colours[0]}`);
	tip.copy(wanted);
	tip2.multiply(tint);
	tip2.setRGB(Math.min(tip2.r, 1), Math.min(tip2.g, 1), Math.min(tip2.b, 1));
}
