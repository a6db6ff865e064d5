// Colour of the hairs, linear: a ramp from root to tip between two tip colours. A texel of a colour plane has the ramp of
// its own hairs in it; there the second tip colour is mixed in, as bright as the texel's tint.

uniform vec3 skinColour; // the model's own base colour
uniform vec3 root; // at the skin
uniform vec3 tip;
uniform vec3 tip2; // of the other tips
uniform float tipShare; // how much of the way there the attributes lead, 0..1
uniform float rampPower;

// tipShare: from tip to tip2; s = 0 at the skin, 1 at the tip. Cut hair keeps the colours of its root half way only: a whole
// ramp would be another animal's, and roots alone are dark.
vec3 furRamp(float tipShare, float s) {
#ifdef COLOUR_PLANE
	tipShare = 1.0;
#endif
	return mix(root, mix(tip, tip2, tipShare), pow(s / sqrt(furTrim), rampPower));
}
