uniform float finOpacity;
#ifdef COLOUR_PLANE
uniform sampler2DArray colourPlane; // the texel's original colour
#endif

in vec2 vAt;
in vec4 vSkin;
in float vFade;
in mat3 vLampLow;
in mat3 vLampHigh;
in mat3 vSkyLow;
in mat3 vSkyHigh;

out vec4 fragColour;

void main() {
	vec3 at = vec3(vAt, 0.0);
	FurTexel texel = furTexel(at, vLampLow, vLampHigh, vSkyLow, vSkyHigh);
	float alpha = texel.alpha * vFade * finOpacity;
	if (alpha < 0.01) discard;
	vec3 colour = furRamp(vSkin.a, clamp(vAt.y, 0.0, 1.0)) * texel.tint;
#ifdef COLOUR_PLANE
	colour = mix(texture(colourPlane, at).rgb, colour, vSkin.a);
#endif
	fragColour = furOutput(vSkin.rgb * colour, texel.light, alpha);
}
