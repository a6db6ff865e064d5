// Numbers and slabs of the hairs of several furs; of one fur alone here, the rest is furs.glsl.

#ifndef REGIONS
#define furWidth 1.0
#define furRegion 0
#endif

#if !defined(REGIONS) || defined(SAME_HAIRS)
#define FURS 1 // furs with numbers and slabs of their own
#define furHairs 0 // number of a fur among them
#define ofFur(list, stride, i) list[i]
#endif
