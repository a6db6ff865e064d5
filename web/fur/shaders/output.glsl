// What a fragment hands on: light as radiance, toned and encoded as the target wants it, premultiplied.

vec4 furOutput(vec3 colour, vec3 light, float alpha) {
	vec3 radiance = colour * light * (0.25 * RECIPROCAL_PI);
#ifdef TONE_MAPPING
	radiance = toneMapping(radiance);
#endif
	return linearToOutputTexel(vec4(radiance, 1.0)) * alpha;
}
