// Colour of the hairs but for what a texel says, linear: the skin's times a ramp from root to tip. A colour plane has the
// ramp of the first tip colour in it; there only the ratio to that counts.

uniform vec3 skinColour; // the model's own base colour
uniform vec3 root; // at the skin
uniform vec3 tip;
uniform vec3 tip2; // of the other tips
uniform float rampPower;

// skin: factor of the model's colour here; tipShare: from tip to tip2; s = 0 at the skin, 1 at the tip.
vec3 furColour(vec3 skin, float tipShare, float s) {
	float t = pow(s, rampPower);
	vec3 ramp = mix(root, mix(tip, tip2, tipShare), t);
#ifdef COLOUR_PLANE
	ramp /= max(mix(root, tip, t), 1e-3);
#endif
	return skinColour * skin * ramp;
}
