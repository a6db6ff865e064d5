// More or fewer hairs than baked: coverage of `density` volumes of the same hairs in one place. Light stays as baked.

#ifdef DENSITY
uniform float density; // number of hairs over the baked one
#endif

float denser(float coverage) {
#ifdef DENSITY
	return 1.0 - pow(1.0 - min(coverage, 0.996), density);
#else
	return coverage;
#endif
}
