
out vec4 fragColour;

void main() {
	vec2 hair = furCoverage(furAt);
	hair.x = crispCoverage(hair.x);
	vec3 strand = strandTS(furAt);
	vec3 colour = hairColour(furAt, hair.y);
	if (hair.x < alphaCut) discard;
	fragColour = furOutput(localRadiance(colour, strand, 1.0), shellOpacity(hair.x));
}
