// Fur of a fragment. Its hairs' numbers decide, at a border, which of them are there.

#ifdef FIN
in vec2 vAt; // tiles along the edge, height
in float vFade; // opacity of the fin, and 2 more for each fur before its own
#else
in vec3 vAt; // XY = tiles, Z = slab, fur after fur
#endif

#ifdef REGIONS
#ifdef FIN
#define furRegion int(0.5 * vFade + 0.25)
#else
#define furRegion (int(vAt.z + 0.5) / LAYERS)
#endif
#endif
