// Cut fur: its lowest share, slabs of unchanged thickness.

#define NUDGE 1e-4 // tolerance at the boundary of slabs, above rounding

#ifdef TRIMMED
#define TOP (int(ceil(furTrim * float(LAYERS) - NUDGE)) - 1) // uppermost slab left
uniform float furTrim; // share of the hairs left: largest s, of the whole hair
#else
#define TOP (LAYERS - 1)
#define furTrim 1.0
#endif
