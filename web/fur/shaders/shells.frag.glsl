in vec3 vAt;

out vec4 fragColour;

#ifdef MULTIPLE
vec3 slabColour(FurPoint point, float tint) {
#ifdef COLOUR_PLANE
	return vColour * mix(ofSlab(point, HAIRS).rgb, furRamp(1.0, vHeight) * tint, vTip2);
#else
	return vColour * tint;
#endif
}
#endif

void main() {
	FurTexel texel = furTexel(vAt);
	vec3 colour = hairColour(vAt, texel.tint);
	if (texel.alpha < alphaCut) discard;
	fragColour = furOutput(furRadiance(texel, colour, receivedLamps(), receivedSky()), shellOpacity(texel.alpha));
}
