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

// Number of a cell, 0..1: PCG (M. E. O'Neill 2014) of its two places.
float numberOf(ivec2 cell) {
	uint h = (uint(cell.x) & 0xffffu) | (uint(cell.y) << 16);
	h = h * 747796405u + 2891336453u;
	h = ((h >> ((h >> 28) + 4u)) ^ h) * 277803737u;
	h = (h >> 22) ^ h;
	return float(h >> 8) / 16777216.0;
}

// Share of this fur in the hairs of a fragment: 0 or 1, and where cells are smaller than pixels their mean.
float furShare() {
	vec2 apart = fwidth(vRoot);
#if REGIONS == 2
	if (vBound >= 1.0) return 1.0;
#else
	if (vLowest <= 0.0 && vHighest >= 1.0) return 1.0;
#endif
	float number = numberOf(ivec2(floor(vRoot)));
#if REGIONS == 2
	float one = step(mix(number, 1.0 - number, furSecond), vBound), mean = clamp(vBound, 0.0, 1.0);
#else
	float one = step(vLowest, number) * step(number, vHighest), mean = clamp(vHighest, 0.0, 1.0) - clamp(vLowest, 0.0, 1.0);
#endif
	return mix(one, mean, smoothstep(0.5, 1.5, max(apart.x, apart.y)));
}
#endif
