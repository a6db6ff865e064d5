in vec3 vMapped;

out vec4 fragColour;

void main() {
	vec2 hair = furCoverage(vAt);
	hair.x = crispCoverage(hair.x);
	vec3 strand = strandTS(vAt);
	float through = deepTransmittance(vMapped);
	vec3 colour = hairColour(vAt, hair.y);
	if (hair.x < alphaCut) discard;
	fragColour = furOutput(localRadiance(colour, strand, through), shellOpacity(hair.x));
}
