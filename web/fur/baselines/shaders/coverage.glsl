// Coverage and tint of a texel by one fetch.

#ifdef TWO_PLANES
uniform sampler2DArray plane1; // (a3, a4, α, tint)
#else
uniform sampler2DArray plane0; // (a0, a1, a2, α)
#endif

// X = coverage of a slab of the baked thickness, seen from straight above; Y = tint.
vec2 furCoverage(vec3 at) {
#ifdef TWO_PLANES
	vec2 hair = furBytes(plane1, at).zw;
	hair.x = denser(hair.x);
#else
	vec2 hair = vec2(denser(furBytes(plane0, at).w), 1.0);
#endif
#ifdef MUD
	vec2 dirty = dirtyBytes(plane1, at).zw;
	hair.x = muddy(hair.x, dirty.y, denser(dirty.x));
#elif defined(DIRTY)
	mudShare = MUD_SHARE * vDirt;
#endif
	return hair;
}
