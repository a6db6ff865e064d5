#ifdef COLOUR_PLANE
uniform sampler2DArray colourPlane; // the texel's original colour (paper, eq. 4)
#endif

in vec3 vAt;
in vec3 vColour;
#ifdef COLOUR_PLANE
in vec4 vPlane;
#endif
in mat3 vLampLow;
in mat3 vLampHigh;
in mat3 vSkyLow;
in mat3 vSkyHigh;

out vec4 fragColour;

void main() {
	FurTexel texel = furTexel(vAt, vLampLow, vLampHigh, vSkyLow, vSkyHigh);
	vec3 colour = vColour * texel.tint;
#ifdef COLOUR_PLANE
	colour = vPlane.a * colour + vPlane.rgb * texture(colourPlane, vAt).rgb;
#endif
	if (texel.alpha < alphaCut) discard;
	fragColour = furOutput(colour, texel.light, shellOpacity(texel.alpha));
}
