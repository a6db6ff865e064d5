uniform float bodyRadius; // β, in lengths of the fur

void main() {
	ShellPoint shell = shellPoint();
	// Shells that face away shade hairs beyond the horizon, as far as tips look over it; all others are moved behind
	// everything, where they cost nothing.
	float cosine = bodyRadius / (bodyRadius + 1.0);
	if (dot(shell.frameVS[2], viewerVS(shell.pointVS)) < -sqrt(1.0 - cosine * cosine)) gl_Position.z = 2.0 * gl_Position.w;
}
