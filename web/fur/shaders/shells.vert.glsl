// WebGL2 promises no more than 15 vectors: four matrices, two vec3 with the scalars in their gaps, and a vec4.
out vec3 vColour; // of the hairs but for the texel's tint, linear
#ifdef COLOUR_PLANE
out vec4 vPlane; // RGB = factor of the texel's original colour, A = share of vColour
#endif
// Light moments of coefficients 0..2 (low) and 3..5 (high), a column each.
out mat3 vLampLow;
out mat3 vLampHigh;
out mat3 vSkyLow;
out mat3 vSkyHigh;

void main() {
	ShellPoint point = shellPoint();
	Moments lamps = lampMoments(point.frameVS, point.pointVS, point.s);
	Moments sky = environmentMoments(point.frameVS);
	vLampLow = lamps.low;
	vLampHigh = lamps.high;
	vSkyLow = sky.low * _fur.z;
	vSkyHigh = sky.high * _fur.z;

	vec3 skin = skinColour * color.rgb;
	vColour = skin * furRamp(_fur.w, point.s);
#ifdef COLOUR_PLANE
	vPlane = vec4(skin * (1.0 - _fur.w), _fur.w);
#endif
}
