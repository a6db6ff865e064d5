in vec3 vMapped;

out vec4 fragColour;

void main() {
	vec2 hair = furCoverage(furAt);
	hair.x = crispCoverage(hair.x);
	vec3 strand = strandTS(furAt);
	float through = deepTransmittance(vMapped);
	vec3 colour = hairColour(furAt, hair.y);
	if (hair.x < alphaCut) discard;
	fragColour = furOutput(localRadiance(colour, strand, through), shellOpacity(hair.x));
}
