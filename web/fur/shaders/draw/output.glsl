// Output of a fragment from 4π·radiance: tone mapped and encoded for the target, premultiplied if blended.

vec4 furOutput(vec3 radiance, float alpha) {
	radiance *= 0.25 * RECIPROCAL_PI;
#ifdef TONE_MAPPING
	radiance = toneMapping(radiance);
#endif
	vec4 encoded = linearToOutputTexel(vec4(radiance, 1.0));
#ifdef ALPHA_TO_COVERAGE
	return vec4(encoded.rgb, alpha);
#else
	return encoded * alpha;
#endif
}
