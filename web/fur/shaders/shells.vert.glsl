void main() {
	ShellPoint shell = shellPoint();
	if (shell.there) {
		vec3 bend = furCurvature(_fur.y);
		passLight(FurPoint(shell.frameVS, shell.comb, shell.pointVS, furReach(_fur.y), shell.s, vAt.z, bend), _fur.z);
	} else {
		passDarkness();
	}
	passColour(shell);
}
