// Coverage and tint of a texel, for those who want no more of it than that: one fetch.

#ifdef TWO_PLANES
uniform sampler2DArray plane1; // (a3, a4, α, tint)
#else
uniform sampler2DArray plane0; // (a0, a1, a2, α)
#endif

#ifndef LOD_BIAS
#define LOD_BIAS 0.0
#endif

// X = coverage of a slab of the baked thickness, seen from straight above; Y = tint.
vec2 furCoverage(vec3 at) {
#ifdef TWO_PLANES
	vec2 hair = texture(plane1, at, LOD_BIAS).zw;
	return vec2(denser(hair.x), hair.y);
#else
	return vec2(denser(texture(plane0, at, LOD_BIAS).w), 1.0);
#endif
}
