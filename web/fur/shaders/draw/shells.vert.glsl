void main() {
	ShellPoint shell = shellPoint();
	passColour(shell);
	vec3 bend = furCurvature(_fur.y);
	passLight(shell.there, FurPoint(shell.frameVS, shell.comb, shell.pointVS, furReach(_fur.y), hairShare(_fur.y), shell.s, float(shell.slab), bend), _fur.z);
}
