void main() {
	passColour(shellPoint());
}
