// Hair above a point of the skin, in the mesh's own units: it leaves along the normal and bends to its comb (Lengyel 2001:
// shells are the skin moved outwards; here along a trajectory). s = 0 at the skin, 1 at the tip.

uniform float furLength; // longest fur, cut included, the mesh's own units

// comb: displacement of the tip in the tangent plane, share of the length; the tip stays as far from the root as uncombed.
float furRise(vec3 comb) {
	return sqrt(max(1.0 - dot(comb, comb), 0.0));
}

vec3 furPoint(vec3 root, vec3 outward, vec3 comb, float lengthShare, float s) {
#ifdef WET
	lengthShare *= furTraits.x;
#endif
#ifdef USE_SKINNING
	lengthShare *= rootScale;
#endif
	return root + (furRise(comb) * outward + s * comb) * (furLength / furTrim * lengthShare * s);
}
