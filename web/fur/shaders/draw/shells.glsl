// Mean colour of the hairs from a shell's varyings; appended to both shaders.

#ifdef MULTIPLE
vec3 slabColour(FurPoint point, float tint) {
#ifdef COLOUR_PLANE
	return baseColour * mix(ofSlab(point, HAIRS).rgb, rampAt(1.0, vRamp) * tint, vTip2);
#else
	return baseColour * tint;
#endif
}
#endif
