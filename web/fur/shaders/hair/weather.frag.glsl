// Texels of wet and dirty fur, mixed from states.

#ifdef FIN
#define SLABS float(FURS)
#else
#define SLABS float(FURS * LAYERS)
#endif

#ifdef WET
centroid in float vPlace;
#define furTraits traitsAt(vPlace)
#define furWetness wetnessAt(vPlace)
#else
#define furWetness 0.0
#endif
#ifdef DIRTY
centroid in float vDirt;
uniform vec3 mud; // colour of the mud
float mudShare = 0.0; // share of mud in the texel's coverage
#define MUD_FILM 0.6 // opacity of mud on the hairs between crumbs
#define MUD_SHARE 0.7 // share of mud on dirty hairs without a dirty state
#endif

// All states share one encoding, so bytes can be mixed.
vec4 furBytes(sampler2DArray plane, vec3 at) {
#ifdef WET
	float below = float(stateBelow(vPlace));
	vec3 lower = vec3(at.xy, at.z + below * SLABS);
	vec4 drier = texture(plane, lower, LOD_BIAS);
	return mix(drier, texture(plane, lower + vec3(0.0, 0.0, SLABS), LOD_BIAS), clamp(vPlace - below, 0.0, 1.0));
#else
	return texture(plane, at, LOD_BIAS);
#endif
}

#ifdef MUD // number of states before the dirty one
vec4 dirtyBytes(sampler2DArray plane, vec3 at) {
	return texture(plane, vec3(at.xy, at.z + float(MUD) * SLABS), LOD_BIAS);
}
#endif

#ifdef DIRTY
// Covers hairs with mud. share: mud in the coverage of the dirty state.
float muddy(float coverage, float share, float dirtyCoverage) {
	float covered = vDirt * share * dirtyCoverage;
	float together = 1.0 - (1.0 - coverage) * (1.0 - covered);
	mudShare = max(covered / max(together, 1e-3), MUD_FILM * vDirt);
	return together;
}
#endif

// Colour of a texel's hairs with mud.
vec3 soiled(vec3 colour) {
#ifdef DIRTY
#ifdef WET
	return mix(colour, mud * furTraits.y, mudShare);
#else
	return mix(colour, mud, mudShare);
#endif
#else
	return colour;
#endif
}
