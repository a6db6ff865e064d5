out vec4 fragColour;

void main() {
	fragColour = vec4(gl_FragCoord.z);
}
