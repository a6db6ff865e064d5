// Several furs on one body: each has numbers of its own, by the number of the fur, and slabs of its own in the textures. Where
// SAME_HAIRS is defined, they differ in size and colours alone, and share the coat's.

#ifdef REGIONS // number of furs
#if REGIONS == 2 // a mix of two is cheaper than a branch or a place in a list
// Fragments need not mix the furs' colours. Three furs leave no room for it in the varyings.
#define Ramp vec3
#define rampOf(place) rampAt(1.0, place)
vec3 rampAt(float tipShare, vec3 colour) {
	return colour;
}
#define byFur(list, stride, i) mix(list[i], list[(stride) + (i)], furSecond)
#else
#define byFur(list, stride, i) list[(stride) * furRegion + (i)]
#endif
uniform float tileWidths[REGIONS]; // widths of a tile over the coat's
#define furWidth byFur(tileWidths, 1, 0)
#ifndef SAME_HAIRS
#define FURS REGIONS
#define furHairs furRegion
#define ofFur byFur
#endif
#ifndef ONE_FUR
#define PARTED // furs share the surface
#endif
#endif
