// Fur of a fragment. Its hairs' numbers decide, at a border, which of them are there.

in vec3 vAt; // XY = tiles, Z = slab, fur after fur; of fins XY = tiles along the edge and height, Z = fur

#ifdef REGIONS
#ifdef FIN
#define furRegion int(vAt.z + 0.5)
#else
#define furRegion (int(vAt.z + 0.5) / LAYERS)
#endif
#endif
