// One law of opacity for the patch's weight, the number of shells and the slant of the view.

#ifdef BODIES
in float vShells; // of this body
in float vCut;
#define shellCount vShells
#define alphaCut vCut
#else
uniform float alphaCut; // coverage below which a fragment is dropped
#ifdef ALPHA_TO_COVERAGE
uniform float shellCount;
#endif
#endif

in float vWeight;
in float vFacing;

// coverage: of a slab of the baked thickness, seen from straight above.
float shellOpacity(float coverage) {
#ifdef ALPHA_TO_COVERAGE
	// Fragments of a pixel all cover the same samples first, and so add up to no more than the densest of them: a hair is
	// there or it is not, with an edge as wide as a pixel.
	float most = min(2.0 * vWeight * shellCount / (furTrim * float(LAYERS)), 1.0); // of the patches that lap over each other here
	return clamp((coverage * most - HAIR) / max(fwidth(coverage), 1e-3) + 0.5, 0.0, 1.0);
#else
	float facing = max(abs(vFacing), 1.0 / MAX_SLANT);
	// Between the samples of a pixel a weight may be extrapolated below 0.
	return 1.0 - pow(1.0 - min(coverage, 0.996), max(vWeight, 0.0) / facing);
#endif
}
