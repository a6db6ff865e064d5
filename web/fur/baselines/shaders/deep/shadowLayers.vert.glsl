uniform mat4 mapFromView; // view space → XY of the light's maps, Z = depth in them

out vec3 vMapped;

void main() {
	ShellPoint shell = shellPoint();
	passColour(shell);
	passLocalLight(shell, _fur.z, true);
	vMapped = (mapFromView * vec4(shell.pointVS, 1.0)).xyz;
}
