// Fur of a fragment. Its hairs' numbers decide, at a border, which of them are there.

#ifdef FIN
in vec2 vAt; // tiles along the edge, height
centroid in float vFade; // opacity of the fin, and 2 more for each fur before its own
#else
in vec3 vAt; // see shell.glsl
#if defined(REGIONS) && defined(SAME_HAIRS)
#define furAt vec3(vAt.xy, vAt.z - float(furRegion * LAYERS))
#else
#define furAt vAt
#endif
#endif

#ifdef REGIONS
#ifdef FIN
#define furRegion int(0.5 * vFade + 0.25)
#define furSecond step(1.5, vFade)
#else
#define furRegion int((vAt.z + 0.25) * (1.0 / float(LAYERS)))
#define furSecond step(float(LAYERS) - 0.25, vAt.z)
#endif
#endif
