// The light of fur that has been cut: slabs get what came to them through the hair above when that is gone.

#ifdef TRIMMED
uniform highp sampler2D trimLight; // a row per slab; X = pull of coefficients 0..2, of 3..5, change of the mean of 0..2, of 3..5

// Moments with which a mean texel of the slab at s has the light of the cut fur, and each its own difference from that.
Moments trimmed(Moments moments, float s) {
	int slab = clamp(int(s * float(LAYERS) - 0.01), 0, LAYERS - 1);
	vec3 change = moments.low * texelFetch(trimLight, ivec2(2, slab), 0).xyz + moments.high * texelFetch(trimLight, ivec2(3, slab), 0).xyz;
	moments.low += outerProduct(change, texelFetch(trimLight, ivec2(0, slab), 0).xyz);
	moments.high += outerProduct(change, texelFetch(trimLight, ivec2(1, slab), 0).xyz);
	return moments;
}

#ifdef ONE_HUE
LampMoments trimmed(LampMoments moments, float s) {
	int slab = clamp(int(s * float(LAYERS) - 0.01), 0, LAYERS - 1);
	float change = dot(moments.low, texelFetch(trimLight, ivec2(2, slab), 0).xyz) + dot(moments.high, texelFetch(trimLight, ivec2(3, slab), 0).xyz);
	moments.low += change * texelFetch(trimLight, ivec2(0, slab), 0).xyz;
	moments.high += change * texelFetch(trimLight, ivec2(1, slab), 0).xyz;
	return moments;
}
#endif
#endif
