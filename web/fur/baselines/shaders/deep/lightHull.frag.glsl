out vec4 fragColour;

void main() {
	fragColour = vec4(gl_FragCoord.z, 1.0, 1.0, 1.0);
}
