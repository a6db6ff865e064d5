// One law of opacity for the patch's weight, the number of shells and the slant of the view.

uniform float alphaCut; // coverage below which a fragment is dropped

in float vWeight;
in float vFacing;

// coverage: of a slab of the baked thickness, seen from straight above.
float shellOpacity(float coverage) {
	float facing = max(abs(vFacing), 1.0 / MAX_SLANT);
	return 1.0 - pow(1.0 - min(coverage, 0.996), vWeight / facing);
}
