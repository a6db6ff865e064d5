/** Usual strength of highlights and of light through the hairs from behind: as bright as traced hairs, see pelt/README.md. */
export const DEFAULT_LOOK = { gloss: 0.25, backlight: 40 };
