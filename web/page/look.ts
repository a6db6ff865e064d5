/** Usual strength of highlights and of light through the hairs from behind: as bright as traced hairs, see pelt/README.md. */
export const DEFAULT_LOOK = { gloss: 0.25, backlight: 40 };
/** Thickness of skin below which ears glow, share of the body's longest side. */
export const GLOW = 0.12;

/** Least over largest channel of tips that keep their colour under the usual highlights: those of the bunny. */
const PALE = 0.4;
/** Strength of the highlights of deep colours over the usual; a picture may have some anywhere. */
const DEEP = 0.4;

/** Colours of a fur, by which the strength of its highlights goes. */
interface Coloured {
	ramp: { tip: readonly number[] };
	/** present where hairs have the colours of a picture */
	roots?: unknown;
}

/** Strength of highlights under which a fur keeps its colour: white ones turn orange into salmon. */
export function glossOf({ ramp: { tip }, roots }: Coloured): number {
	const paleness = Math.min(...tip) / Math.max(...tip, 1e-6);
	return DEFAULT_LOOK.gloss * (roots ? DEEP : Math.min(Math.max(paleness / PALE, DEEP), 1));
}
