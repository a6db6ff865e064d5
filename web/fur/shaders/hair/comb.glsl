// Displacement of the hair at a vertex in its body's pose: comb plus swing.

#ifdef SWING
uniform highp sampler2D swing; // texel per follicle: XYZ = displacement of the tip beyond its comb, share of the length, the mesh's own axes
#endif

// comb: displacement of the tip in the tangent plane, share of the length, the mesh's own axes, at rest.
vec3 furComb(vec3 comb) {
#ifdef SWING
	comb += texelFetch(swing, follicleTexel(), 0).xyz;
#endif
	return posedDisplacement(comb);
}

// comb: as above, but in the pose.
vec3 finComb(vec3 comb) {
#ifdef SWING
	return comb + posedDisplacement(texelFetch(swing, follicleTexel(), 0).xyz);
#else
	return comb;
#endif
}
