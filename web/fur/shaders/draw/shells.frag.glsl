
out vec4 fragColour;

void main() {
	FurTexel texel = furTexel(furAt);
	texel.alpha = crispCoverage(texel.alpha);
	vec3 colour = hairColour(furAt, texel.tint);
	if (texel.alpha < alphaCut) discard;
	fragColour = furOutput(furRadiance(texel, colour, receivedLamps(), receivedSky()), shellOpacity(texel.alpha));
}
