void main() {
	ShellPoint shell = shellPoint();
	passColour(shell);
	passLocalLight(shell, _fur.z, false);
}
