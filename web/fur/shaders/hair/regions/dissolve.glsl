// Border between two furs: a hair is of the fur between whose bounds its number lies. The number is that of the cell of the
// surface in which the hair has its root, so that it is the same from root to tip, and in all furs.

#ifdef PARTED
#if REGIONS == 2
centroid in float vBound; // see shell.glsl
#else
centroid in float vLowest;
centroid in float vHighest;
#endif
in vec2 vRoot; // root of the hairs, cells
uniform float hardness; // see regionUniforms.ts

// Number of a cell, 0..1: PCG (M. E. O'Neill 2014) of its two places.
float numberOf(ivec2 cell) {
	uint h = (uint(cell.x) & 0xffffu) | (uint(cell.y) << 16);
	h = h * 747796405u + 2891336453u;
	h = ((h >> ((h >> 28) + 4u)) ^ h) * 277803737u;
	h = (h >> 22) ^ h;
	return float(h >> 8) / 16777216.0;
}

// Share of the fur below a bound in hairs of this number: 1 below it, 0 above, and where cells are smaller than pixels the bound.
float shareBelow(float bound, float number) {
	return clamp((bound - number) * hardness + number, 0.0, 1.0);
}

// Share of this fur in the hairs of a fragment. A branch would save nothing: software runs both sides.
float furShare() {
	float number = numberOf(ivec2(floor(vRoot)));
#if REGIONS == 2
	return shareBelow(vBound, abs(furSecond - number));
#else
	return shareBelow(vHighest, number) - shareBelow(vLowest, number);
#endif
}
#endif
