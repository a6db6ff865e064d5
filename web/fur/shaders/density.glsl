// More hairs or fewer than were baked: coverage as if as many volumes of the same hairs stood in each other's place. The
// light that texels hold stays what it was baked with.

#ifdef DENSITY
uniform float density; // hairs over those that were baked
#endif

float denser(float coverage) {
#ifdef DENSITY
	return 1.0 - pow(1.0 - min(coverage, 0.996), density);
#else
	return coverage;
#endif
}
