// Several furs on one body: each has numbers of its own, by the number of the fur, and slabs of its own in the textures.

#ifdef REGIONS // number of furs
#define FURS REGIONS
#if REGIONS == 2 // a mix of two is cheaper than a branch or a place in a list
#define ofFur(list, stride, i) mix(list[i], list[(stride) + (i)], furSecond)
#else
#define ofFur(list, stride, i) list[(stride) * furRegion + (i)]
#endif
uniform float tileWidths[REGIONS]; // widths of a tile over the coat's
#define furWidth ofFur(tileWidths, 1, 0)
#else
#define ofFur(list, stride, i) list[i]
#define furWidth 1.0
#define FURS 1
#define furRegion 0
#endif

#if defined(REGIONS) && !defined(ONE_FUR)
#define PARTED // furs share the surface
#if defined(BACKLIGHT) || defined(BODIES)
#define TIGHT // no varyings are left for places that a fragment can find by itself
#define RAMP_SHARE 0.5
#endif
#endif
