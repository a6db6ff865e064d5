/** Style of a fur by the view: gloss, density, length, colour and shells. */

import type { Fur } from '../../fur/index.ts';
import { DEFAULT_LOOK, GLOW } from '../../page/look.ts';
import type { View } from '../state/view.ts';
import { paint } from './colours.ts';

export function style(fur: Fur, gloss = DEFAULT_LOOK.gloss, { shells, length = 1, density = 1, colour }: View): void {
	const { material } = fur.shells;
	material.gloss = gloss;
	material.backlight = DEFAULT_LOOK.backlight;
	material.glow = GLOW * fur.extent;
	material.density = density;
	fur.length = length * fur.asset.length;
	if (shells) fur.shells.shellCount = shells;
	else fur.shells.automatic = true;
	paint(fur, colour);
}
