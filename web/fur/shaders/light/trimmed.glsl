// Light of cut fur: slabs get the light that the removed hair used to stop.

#ifdef TRIMMED
uniform highp sampler2D trimLight; // a row per slab, fur after fur; X = pull of coefficients 0..2, of 3..5, change of the mean of 0..2, of 3..5

// Moments that give the mean texel of the slab at s the light of cut fur, and keep each texel's difference from the mean.
Strengths trimmed(Strengths moments, float s) {
	int slab = clamp(int(s * float(LAYERS) - 0.01), 0, LAYERS - 1) + furHairs * LAYERS;
	float change = dot(moments.low, texelFetch(trimLight, ivec2(2, slab), 0).xyz) + dot(moments.high, texelFetch(trimLight, ivec2(3, slab), 0).xyz);
	moments.low += change * texelFetch(trimLight, ivec2(0, slab), 0).xyz;
	moments.high += change * texelFetch(trimLight, ivec2(1, slab), 0).xyz;
	return moments;
}

#ifndef ONE_HUE
Moments trimmed(Moments moments, float s) {
	int slab = clamp(int(s * float(LAYERS) - 0.01), 0, LAYERS - 1) + furHairs * LAYERS;
	vec3 change = moments.low * texelFetch(trimLight, ivec2(2, slab), 0).xyz + moments.high * texelFetch(trimLight, ivec2(3, slab), 0).xyz;
	moments.low += outerProduct(change, texelFetch(trimLight, ivec2(0, slab), 0).xyz);
	moments.high += outerProduct(change, texelFetch(trimLight, ivec2(1, slab), 0).xyz);
	return moments;
}
#endif
#endif
