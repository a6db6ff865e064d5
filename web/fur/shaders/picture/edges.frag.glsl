// Smoothing of long edges: pixels move by the share by which the edge lies off them (Lottes, FXAA 3.11, 2011, edges alone).
// Finer detail, such as single hairs, stays.

uniform sampler2D picture; // linear; alpha 0 where a marked mesh is seen, 1 elsewhere
uniform vec2 texel; // size of a texel: 1 / the picture's size

in vec2 place;

layout(location = 0) out vec4 colour;

// Value that separates the sides of an edge, 0..1: mark or perceived brightness.
float side(vec4 seen, bool marks) {
	return marks ? seen.a : sqrt(clamp(dot(seen.rgb, vec3(0.2126, 0.7152, 0.0722)), 0.0, 1.0));
}

float side(vec2 at, bool marks) {
	return side(textureLod(picture, at, 0.0), marks);
}

// Pixels to the end of the edge on one side, and by how much it differs from the edge's middle there.
vec2 follow(vec2 from, vec2 step, float middle, float enough, bool marks) {
	float away = 0.0;
	float apart = 0.0;
	for (int i = 0; i < STEPS; i++) {
		away += i < 4 ? 1.0 : 2.0;
		apart = side(from + away * step, marks) - middle;
		if (abs(apart) >= enough) break;
	}
	return vec2(away, apart);
}

void main() {
	vec2 x = vec2(texel.x, 0.0);
	vec2 y = vec2(0.0, texel.y);
	vec4 own = textureLod(picture, place, 0.0);
	vec4 north = textureLod(picture, place + y, 0.0), south = textureLod(picture, place - y, 0.0);
	vec4 east = textureLod(picture, place + x, 0.0), west = textureLod(picture, place - x, 0.0);
	colour = vec4(own.rgb, 1.0);
	// Outline of a marked mesh.
	vec4 marked = abs(vec4(north.a, south.a, east.a, west.a) - own.a);
	bool marks = max(max(marked.x, marked.y), max(marked.z, marked.w)) > 0.25;
	float here = side(own, marks);
	float n = side(north, marks), s = side(south, marks), e = side(east, marks), w = side(west, marks);
	float most = max(here, max(max(n, s), max(e, w)));
	if (most - min(here, min(min(n, s), min(e, w))) < max(MIN_CONTRAST, SHARE * most)) return;

	float ne = side(place + y + x, marks), nw = side(place + y - x, marks);
	float se = side(place - y + x, marks), sw = side(place - y - x, marks);
	float lying = abs(nw + sw - 2.0 * w) + 2.0 * abs(n + s - 2.0 * here) + abs(ne + se - 2.0 * e);
	float standing = abs(nw + ne - 2.0 * n) + 2.0 * abs(w + e - 2.0 * here) + abs(sw + se - 2.0 * s);
	bool horizontal = lying >= standing;
	float above = horizontal ? n : e;
	float below = horizontal ? s : w;
	bool up = abs(above - here) >= abs(below - here);
	vec2 across = (horizontal ? y : x) * (up ? 1.0 : -1.0);
	vec2 along = horizontal ? x : y;
	float other = up ? above : below;
	float middle = 0.5 * (here + other);
	float enough = 0.25 * abs(other - here);
	vec2 edge = place + 0.5 * across;
	vec2 back = follow(edge, -along, middle, enough, marks);
	vec2 forth = follow(edge, along, middle, enough, marks);
	vec2 nearer = back.x < forth.x ? back : forth;
	// Skip unless the edge's nearer end turns away on the other side.
	if ((nearer.y < 0.0) == (here < middle)) return;

	// Mix in perceived brightness, not linear: a bright edge would keep its steps.
	vec3 beside = (horizontal ? (up ? north : south) : (up ? east : west)).rgb;
	vec3 mixed = mix(sqrt(max(own.rgb, 0.0)), sqrt(max(beside, 0.0)), 0.5 - nearer.x / (back.x + forth.x));
	colour.rgb = mixed * mixed;
}
