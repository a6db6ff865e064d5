// Colour of the hairs, linear: a ramp from root to tip with two tip colours. A colour plane already contains the ramp;
// there the second tip colour is mixed in, scaled by the texel's tint.

uniform vec3 skinColor; // the model's own base colour
uniform vec3 root; // colour at the skin
uniform vec3 tip;
uniform vec3 tip2; // second colour of the tips
uniform float tipShare; // strength of tip2, 0..1
uniform float rampPower;
#ifdef REGIONS
uniform vec3 regionRamps[3 * REGIONS]; // root, tip, tip2 of each fur; the coat's are those above
uniform float regionPowers[REGIONS];
#endif

// tipShare: mix of tip and tip2; s = 0 at the skin, 1 at the tip. Cut hair has the colours half way between its own roots
// and a whole ramp: a whole ramp would be another animal's, and roots alone are dark.
vec3 furRamp(float tipShare, float s) {
#ifdef COLOUR_PLANE
	tipShare = 1.0;
#endif
#ifdef REGIONS
	if (furRegion > 0) {
		int own = 3 * furRegion;
		return mix(regionRamps[own], mix(regionRamps[own + 1], regionRamps[own + 2], tipShare), pow(s / sqrt(furTrim), regionPowers[furRegion]));
	}
#endif
	return mix(root, mix(tip, tip2, tipShare), pow(s / sqrt(furTrim), rampPower));
}
