// Wetness and dirt of the hairs at a vertex.

#if defined(WET) || defined(DIRTY)
uniform highp sampler2D stains; // texel per follicle: R = wetness, G = dirt; 1 is STAIN_STEPS / 255
#define STAIN_STEPS 240.0
#endif
#ifdef WET
centroid out float vPlace; // place among the states
vec4 furTraits;
#endif
#ifdef DIRTY
centroid out float vDirt;
#endif

// Reads the weather; call it before all other functions of the hairs.
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
