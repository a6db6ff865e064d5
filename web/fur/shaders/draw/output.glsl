// Output of a fragment from 4π·radiance: tone mapped, encoded for the target and in the scene's fog, premultiplied if blended.

#ifdef USE_FOG
uniform vec3 fogColor; // encoded as the target is
#ifdef FOG_EXP2
uniform float fogDensity;
#else
uniform float fogNear;
uniform float fogFar;
#endif
#endif
#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
uniform float logDepthBufFC;
#endif

vec4 furOutput(vec3 radiance, float alpha) {
	radiance *= 0.25 * RECIPROCAL_PI;
#ifdef TONE_MAPPING
	radiance = toneMapping(radiance);
#endif
	vec4 encoded = linearToOutputTexel(vec4(radiance, 1.0));
	float away = 1.0 / gl_FragCoord.w; // distance along the view of a perspective camera
#ifdef USE_FOG
#ifdef FOG_EXP2
	encoded.rgb = mix(fogColor, encoded.rgb, exp(-fogDensity * fogDensity * away * away));
#else
	encoded.rgb = mix(encoded.rgb, fogColor, smoothstep(fogNear, fogFar, away));
#endif
#endif
#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	gl_FragDepth = isOrthographic ? gl_FragCoord.z : 0.5 * log2(1.0 + away) * logDepthBufFC;
#endif
#ifdef ALPHA_TO_COVERAGE
	return vec4(encoded.rgb, alpha);
#else
	return encoded * alpha;
#endif
}
