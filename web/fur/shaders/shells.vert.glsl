void main() {
	ShellPoint shell = shellPoint();
	vec3 tip = position + shell.normal * (furLength * _fur.y);
	if (shell.there) {
		vec3 tipWS = (bodyModel() * vec4(tip, 1.0)).xyz;
		passLight(FurPoint(shell.frameVS, shell.comb, shell.pointVS, tipWS, shell.s, vAt.z, furCurvature(_fur.y)), _fur.z);
	} else {
		passDarkness();
	}
	passColour(shell);
}
