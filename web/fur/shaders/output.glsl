// What a fragment hands on: 4π·radiance, toned and encoded as the target wants it, premultiplied if it is blended.

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
