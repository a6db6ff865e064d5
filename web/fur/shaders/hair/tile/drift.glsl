// Drift of the hairs inside the tile of their fur.

uniform vec4 drift[FURS * ((LAYERS + 2) / 2)]; // two knots each, fur after fur: mean displacement of the hairs at the root and in every slab's middle, tile widths

vec2 driftKnot(int k) {
	vec4 two = drift[furHairs * ((LAYERS + 2) / 2) + (k >> 1)];
	return (k & 1) == 0 ? two.xy : two.zw;
}

// Tiles of the roots of a shell's hairs, which stand aside of them by the drift of their slab. at: tiles and slab, fur after fur
vec2 rootTiles(vec3 at) {
	return at.xy - driftKnot(int(at.z + 0.5) - furHairs * LAYERS + 1);
}

// Mean displacement of the hairs: 0 at the root, linear between slab middles and on beyond the last. slope: of that line
vec2 driftAt(float s, out vec2 slope) {
	float x = s * float(LAYERS) + 0.5;
	int k = LAYERS == 1 ? 0 : min(int(x), LAYERS - 1);
	vec2 above = driftKnot(k + 1), below = k == 0 ? -above : driftKnot(k); // the first slab's middle is half a slab up
	slope = (above - below) * float(LAYERS);
	return mix(below, above, x - float(k));
}
