// How wet and how dirty the hairs at a vertex are.

#if defined(WET) || defined(DIRTY)
uniform highp sampler2D stains; // of each follicle, R = wetness, G = dirt: 1 is STAIN_STEPS / 255
#define STAIN_STEPS 240.0
#endif
#ifdef WET
out float vPlace; // among the states
vec4 furTraits;
#endif
#ifdef DIRTY
out float vDirt;
#endif

// To be called before anything else of the hairs.
void feelWeather() {
#if defined(WET) || defined(DIRTY)
	vec2 stain = texelFetch(stains, follicleTexel(), 0).rg * (255.0 / STAIN_STEPS);
#endif
#ifdef WET
	vPlace = placeOf(stain.r);
	furTraits = traitsAt(vPlace);
#endif
#ifdef DIRTY
	vDirt = stain.g;
#endif
}
