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

#if !defined(REGIONS)
#define OWN(coat, list, stride, i) coat
#elif REGIONS == 2
#define OWN(coat, list, stride, i) mix(coat, list[(stride) + (i)], furSecond)
#else
#define OWN(coat, list, stride, i) (furRegion == 0 ? coat : list[(stride) * furRegion + (i)])
#endif

// Place on the ramp of a point of the hair. s = 0 at the skin, 1 at the tip. Cut hair has the colours half way between its own
// roots and a whole ramp: a whole ramp would be another animal's, and roots alone are dark.
float rampPlace(float s) {
	return pow(s / sqrt(furTrim), OWN(rampPower, regionPowers, 1, 0));
}

// Colour at a place on the ramp. tipShare: mix of tip and tip2
vec3 rampAt(float tipShare, float place) {
#ifdef COLOUR_PLANE
	return mix(OWN(root, regionRamps, 3, 0), OWN(tip2, regionRamps, 3, 2), place);
#else
	return mix(OWN(root, regionRamps, 3, 0), mix(OWN(tip, regionRamps, 3, 1), OWN(tip2, regionRamps, 3, 2), tipShare), place);
#endif
}

// Varying vRamp: the place on the ramp; of two furs the colour of tip2 there, see furs.glsl.
#ifndef Ramp
#define Ramp float
#define rampOf
#endif

vec3 furRamp(float tipShare, float s) {
	return rampAt(tipShare, rampPlace(s));
}
