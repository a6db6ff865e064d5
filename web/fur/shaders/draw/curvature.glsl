// Curvature and length of the hair at a vertex.

layout(location = 10) in vec3 curvature; // curvature of the skin, per the mesh's own unit: along the frame's first level axis, along the second, mixed

// Curvature per length of a hair. lengthShare: over the longest hair.
vec3 furCurvature(float lengthShare) {
#ifdef WET
	lengthShare *= furTraits.x;
#endif
	return curvature * (furLength * lengthShare);
}

// Length of the hair, world units.
float furReach(float lengthShare) {
#ifdef WET
	lengthShare *= furTraits.x;
#endif
#ifdef USE_SKINNING
	lengthShare *= rootScale;
#endif
	return furLength * lengthShare * length(bodyModel()[0].xyz);
}

// Length of the hair over that of the pelt's. lengthShare: as above
float hairShare(float lengthShare) {
	return clamp(furLength / furTrim * lengthShare * ofFur(shorts, 1, 0).w / furWidth, SHORTEST, 1.0);
}

// Hairs in an area at height s over those in it at the skin: they diverge. bend: as furCurvature, whose light knows no smaller
// body than β = 1 either.
float divergence(vec3 bend, vec3 comb, float s) {
	float rise = s / furTrim * furRise(comb);
	return 1.0 / clamp(1.0 + rise * (bend.x + bend.y) + rise * rise * (bend.x * bend.y - bend.z * bend.z), 1.0, 4.0);
}
