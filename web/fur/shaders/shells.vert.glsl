void main() {
	ShellPoint shell = shellPoint();
	vec3 tip = position + shell.normal * (furLength * _fur.y);
	if (shell.there)
		passLight(FurPoint(shell.frameVS, shell.comb, shell.pointVS, (bodyModel() * vec4(tip, 1.0)).xyz, shell.s), _fur.z);
	else passDarkness();
	passColour(shell);
}
