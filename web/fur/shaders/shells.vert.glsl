void main() {
	ShellPoint shell = shellPoint();
	if (shell.there) {
		vec4 tip = furTip(shell.normal, _fur.y);
		vec3 bend = furCurvature(_fur.y);
		passLight(FurPoint(shell.frameVS, shell.comb, shell.pointVS, tip.xyz, tip.w, shell.s, vAt.z, bend), _fur.z);
	} else {
		passDarkness();
	}
	passColour(shell);
}
