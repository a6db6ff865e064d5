// The hairs' mean colour, by what a fin's vertices hand on: at the end of both shaders.

#ifdef MULTIPLE
vec3 slabColour(FurPoint point, float tint) {
	vec3 colour = furRamp(vSkin.a, point.s) * tint;
#ifdef COLOUR_PLANE
	colour = mix(ofSlab(point, HAIRS).rgb, colour, vSkin.a);
#endif
	return vSkin.rgb * colour;
}
#endif
