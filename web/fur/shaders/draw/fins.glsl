// Mean colour of the hairs from a fin's varyings; appended to both shaders.

#ifdef MULTIPLE
vec3 slabColour(FurPoint point, float tint) {
	vec3 colour = furRamp(vSkin.a, point.s) * tint;
#ifdef COLOUR_PLANE
	colour = mix(ofSlab(point, HAIRS).rgb, colour, vSkin.a);
#endif
	return baseColour * colour;
}
#endif
