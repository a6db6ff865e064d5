// Stair steps of a long edge, moved by the share of a pixel that the edge lies off them: Lottes, FXAA 3.11 (2011), edges
// alone. What is finer than an edge, such as single hairs, stays as it is.

uniform sampler2D picture; // linear; alpha 0 where a marked mesh is seen, 1 elsewhere
uniform vec2 texel; // of the picture: 1 / its size

in vec2 place;

layout(location = 0) out vec4 colour;

// What tells the sides of an edge apart, 0..1: what is marked, or how bright it looks.
float side(vec2 at, bool marks) {
	vec4 seen = textureLod(picture, at, 0.0);
	return marks ? seen.a : sqrt(clamp(dot(seen.rgb, vec3(0.2126, 0.7152, 0.0722)), 0.0, 1.0));
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

// The neighbour across the edge, and how much of it belongs here (Z).
vec3 neighbour(vec2 at, bool marks) {
	vec2 x = vec2(texel.x, 0.0);
	vec2 y = vec2(0.0, texel.y);
	float here = side(at, marks);
	float n = side(at + y, marks), s = side(at - y, marks), e = side(at + x, marks), w = side(at - x, marks);
	float most = max(here, max(max(n, s), max(e, w)));
	if (most - min(here, min(min(n, s), min(e, w))) < max(LEAST, SHARE * most)) return vec3(0.0);
	float ne = side(at + y + x, marks), nw = side(at + y - x, marks);
	float se = side(at - y + x, marks), sw = side(at - y - x, marks);
	float lying = abs(nw + sw - 2.0 * w) + 2.0 * abs(n + s - 2.0 * here) + abs(ne + se - 2.0 * e);
	float standing = abs(nw + ne - 2.0 * n) + 2.0 * abs(w + e - 2.0 * here) + abs(sw + se - 2.0 * s);
	vec2 across = lying >= standing ? y : x;
	vec2 along = lying >= standing ? x : y;
	float above = lying >= standing ? n : e;
	float below = lying >= standing ? s : w;
	bool up = abs(above - here) >= abs(below - here);
	float other = up ? above : below;
	if (!up) across = -across;
	float middle = 0.5 * (here + other);
	float enough = 0.25 * abs(other - here);
	vec2 edge = at + 0.5 * across;
	vec2 back = follow(edge, -along, middle, enough, marks);
	vec2 forth = follow(edge, along, middle, enough, marks);
	vec2 nearer = back.x < forth.x ? back : forth;
	// The step lies on this side where the edge's nearer end goes the other way.
	bool steps = (nearer.y < 0.0) != (here < middle);
	return vec3(across, steps ? 0.5 - nearer.x / (back.x + forth.x) : 0.0);
}

// Whether the outline of a marked mesh goes through here.
bool marked(vec2 at) {
	float here = textureLod(picture, at, 0.0).a;
	float apart = 0.0;
	for (int i = 0; i < 4; i++) {
		vec2 to = texel * (i < 2 ? vec2(float(2 * i - 1), 0.0) : vec2(0.0, float(2 * i - 5)));
		apart = max(apart, abs(textureLod(picture, at + to, 0.0).a - here));
	}
	return apart > 0.25;
}

void main() {
	colour = vec4(textureLod(picture, place, 0.0).rgb, 1.0);
	vec3 other = neighbour(place, marked(place));
	if (other.z <= 0.0) return;
	// As bright as it looks, not as it is: a bright edge would go on to have steps.
	vec3 beside = textureLod(picture, place + other.xy, 0.0).rgb;
	vec3 mixed = mix(sqrt(max(colour.rgb, 0.0)), sqrt(max(beside, 0.0)), other.z);
	colour.rgb = mixed * mixed;
}
