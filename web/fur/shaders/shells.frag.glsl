uniform float slabsPerShell; // K / n: how much fur one drawn shell stands for
uniform float alphaCut; // coverage below which a fragment is dropped
#ifdef COLOUR_PLANE
uniform sampler2DArray colourPlane; // the texel's original colour (paper, eq. 4)
#endif

in vec3 vAt;
in vec3 vColour;
#ifdef COLOUR_PLANE
in vec4 vPlane;
#endif
in float vWeight;
in float vFacing;
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

	// One law of opacity for the patch's weight, the number of shells and the slant of the view.
	float facing = max(abs(vFacing), 1.0 / MAX_SLANT);
	float alpha = 1.0 - pow(1.0 - min(texel.alpha, 0.996), vWeight * slabsPerShell / facing);
	fragColour = furOutput(colour, texel.light, alpha);
}
