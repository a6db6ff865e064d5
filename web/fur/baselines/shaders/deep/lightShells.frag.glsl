
out vec4 fragColour;

void main() {
	// −ln(1 − α'), by the law of opacity.glsl. No alpha cut: haze shades too, and needs no order.
	float coverage = furCoverage(furAt).x;
	float opacity = -log(1.0 - min(coverage, 0.996)) * vWeight / max(abs(vFacing), 1.0 / MAX_SLANT);
	fragColour = deepLayers(gl_FragCoord.z, opacity);
}
