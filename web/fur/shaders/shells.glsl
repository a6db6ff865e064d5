// The hairs' mean colour, by what a shell's vertices hand on: at the end of both shaders.

#ifdef MULTIPLE
vec3 slabColour(FurPoint point, float tint) {
#ifdef COLOUR_PLANE
	return vColour * mix(ofSlab(point, HAIRS).rgb, furRamp(1.0, vHeight) * tint, vTip2);
#else
	return vColour * tint;
#endif
}
#endif
