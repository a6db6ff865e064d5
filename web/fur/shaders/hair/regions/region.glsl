// Several furs on one body: each has numbers of its own, by the number of the fur, and slabs of its own in the textures.

#ifdef REGIONS // number of furs
#define FURS REGIONS
uniform float tileWidths[REGIONS]; // widths of a tile over the coat's
#define furWidth tileWidths[furRegion]
#else
#define furWidth 1.0
#define FURS 1
#define furRegion 0
#endif

#if defined(REGIONS) && !defined(ONE_FUR)
#define PARTED // furs share the surface
#endif
