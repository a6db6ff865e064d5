// Light at the vertices of the body, drawn once per picture (see BodyLight) and looked up by all shells: an entry per
// directional lamp, then one per height of the sky's light.

uniform ivec3 bodyEntries; // X = vertices in a row of texels, Y = rows of an entry, Z = heights of the sky's light

ivec2 bodyTexel(int vertex, int entry) {
	return ivec2(vertex % bodyEntries.x, vertex / bodyEntries.x + entry * bodyEntries.y);
}

// Uppermost height of the sky's light that is needed: cut fur may have fewer slabs than heights.
int lastHeight() {
	return min(bodyEntries.z - 1, max(TOP, 1));
}

// Slab that stands for a height of the sky's light.
int storedSlab(int height) {
	int last = lastHeight();
	return min((2 * height * TOP + last) / (2 * last), TOP);
}

#ifdef BODY_LIGHT
#define STORED_ARRIVALS
// Bits of floats. A lamp: 0 = height, radius, lightTS along the frame's two level axes; 1 = curves; 2 = nap, surge. With light
// curves whose φ is costly 1 and 2 are halves, two to a word: 1 = curves, nap, surge; 2 = none, φ. The sky: see packSky.
uniform highp usampler2D bodyLight0;
uniform highp usampler2D bodyLight1;
uniform highp usampler2D bodyLight2;
#endif
