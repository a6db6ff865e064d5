uniform vec3 root; // colour at the skin, linear
uniform vec3 tip; // colour at the tips, linear
uniform float rampPower;
uniform vec3 skinColour; // the model's own base colour, linear: multiplies the fur's
uniform float slabsPerShell; // K / n: how much fur one drawn shell stands for
uniform float alphaCut; // coverage below which a fragment is dropped
#ifdef COLOUR_PLANE
uniform sampler2DArray colourPlane; // the texel's original colour (paper, eq. 4)
#endif

in vec2 vUv;
in float vWeight;
in vec3 vNormalVS;
in vec3 vViewVS;
in mat3 vLampLow;
in mat3 vLampHigh;
in mat3 vSkyLow;
in mat3 vSkyHigh;
flat in vec2 vShell;

out vec4 fragColour;

void main() {
	vec3 at = vec3(vUv, vShell.y);
	FurTexel texel = furTexel(at, vLampLow, vLampHigh, vSkyLow, vSkyHigh);
#ifdef COLOUR_PLANE
	vec3 colour = texture(colourPlane, at).rgb;
#else
	vec3 colour = mix(root, tip, pow(vShell.x, rampPower)) * texel.tint;
#endif
	if (texel.alpha < alphaCut) discard;

	// One law of opacity for the patch's weight, the number of shells and the slant of the view.
	float facing = max(abs(dot(normalize(vNormalVS), normalize(vViewVS))), 1.0 / MAX_SLANT);
	float alpha = 1.0 - pow(1.0 - min(texel.alpha, 0.996), vWeight * slabsPerShell / facing);

	vec3 radiance = skinColour * colour * texel.light * (0.25 * RECIPROCAL_PI);
#ifdef TONE_MAPPING
	radiance = toneMapping(radiance);
#endif
	fragColour = linearToOutputTexel(vec4(radiance, 1.0)) * alpha;
}
