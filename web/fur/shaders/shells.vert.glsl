#ifdef MULTIPLE
vec3 slabColour(FurPoint point, float tint) {
	vec3 colour = skinColour * color.rgb;
#ifdef WET
	colour *= furTraits.y;
#endif
#ifdef COLOUR_PLANE
	return colour * mix(ofSlab(point, HAIRS).rgb, furRamp(1.0, point.s) * tint, tipShare * _fur.w);
#else
	return colour * furRamp(tipShare * _fur.w, point.s) * tint;
#endif
}
#endif

void main() {
	ShellPoint shell = shellPoint();
	if (shell.there) {
		vec3 bend = furCurvature(_fur.y);
		passLight(FurPoint(shell.frameVS, shell.comb, shell.pointVS, furReach(_fur.y), shell.s, vAt.z, bend), _fur.z);
	} else {
		passDarkness();
	}
	passColour(shell);
}
