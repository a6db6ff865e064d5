// Displacement of the hair at a vertex: comb plus swing.

#ifdef SWING
uniform highp sampler2D swing; // texel per follicle: XYZ = displacement of the tip beyond its comb, share of the length, the mesh's own axes
#endif

// comb: displacement of the tip in the tangent plane, share of the length, the mesh's own axes.
vec3 furComb(vec3 comb) {
#ifdef SWING
	return comb + texelFetch(swing, follicleTexel(), 0).xyz;
#else
	return comb;
#endif
}
