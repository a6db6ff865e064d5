// Opacity by the patch's weight, the number of shells and the slant of the view.

#ifdef BODIES
centroid in float vShells; // shells of this body
flat in uint vDetail; // see shell.glsl
#define shellCount vShells
#define alphaCut unpackHalf2x16(vDetail).x
#define crispness unpackHalf2x16(vDetail).yx
#else
uniform float alphaCut; // coverage below which a fragment is dropped
uniform vec2 crispness; // X = contrast of coverage over the texels'
#ifdef ALPHA_TO_COVERAGE
uniform float shellCount;
#endif
#endif

centroid in float vWeight;
centroid in float vFacing;

#ifndef PARTED
#define furShare() 1.0
#endif

in float vKept; // coverage that crispness leaves alone

// Coverage with the contrast of this picture, see crisp.ts.
float crispCoverage(float coverage) {
	return clamp((coverage - vKept) * crispness.x + vKept, 0.0, 1.0);
}

// coverage: that of a slab of the baked thickness, seen from straight above. Drops fragments of other furs' hairs.
float shellOpacity(float coverage) {
	float kept = furShare();
	if (kept <= 0.0) discard;
#ifdef ALPHA_TO_COVERAGE
	// Fragments of a pixel all cover the same samples first, so together no more than the densest: hairs get an edge one pixel
	// wide.
	float most = min(2.0 * vWeight * kept * shellCount / (furTrim * float(LAYERS)), 1.0); // share of the overlapping patches here
	return clamp((coverage * most - HAIR) / max(fwidth(coverage), 1e-3) + 0.5, 0.0, 1.0);
#else
	float facing = max(abs(vFacing), 1.0 / MAX_SLANT);
	return 1.0 - pow(1.0 - min(coverage, 0.996), vWeight * kept / facing);
#endif
}
