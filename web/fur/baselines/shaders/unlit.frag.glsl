// Colour without light: the cost of shells alone.

uniform float brightness; // radiance of a white hair


out vec4 fragColour;

void main() {
	vec2 hair = furCoverage(furAt);
	hair.x = crispCoverage(hair.x);
	vec3 colour = hairColour(furAt, hair.y);
	if (hair.x < alphaCut) discard;
	fragColour = furOutput(colour * (brightness * 4.0 * PI), shellOpacity(hair.x));
}
