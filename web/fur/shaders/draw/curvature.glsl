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
