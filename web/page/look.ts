/** Usual strength of highlights and of light through the hairs from behind: as bright as traced hairs, see pelt/README.md. */
export const DEFAULT_LOOK = { gloss: 0.25, backlight: 40 };
/** Thickness of skin below which ears glow, share of the body's longest side. */
export const GLOW = 0.12;
