// Sub-step of a follicle's spring, equal to `CpuSprings`; axes of the shells' mesh.

precision highp float;
precision highp int;
precision highp sampler2D;

uniform int count; // number of follicles
uniform sampler2D places; // XYZ = position, W = share of the longest fur
uniform sampler2D normals; // XYZ, W = first link
uniform sampler2D combs; // XYZ = displacement of the tip as combed, share of the length; W = number of links
uniform sampler2D links; // X = neighbour, Y = weight
uniform sampler2D offsets; // XYZ = displacement by strokes, before the factor `fade`
uniform sampler2D displacements; // XYZ = displacement at the beginning, shares of the length
uniform sampler2D velocities; // XYZ = velocity at the beginning, 1/s

uniform vec4 spring; // x' = lead + X·(x - lead) + Y·v, v' = Z·(x - lead) + W·v
uniform float fastest; // largest velocity, 1/s
uniform vec3 sag; // displacement of the longest fur by gravity alone
uniform vec3 blow; // unit vector along the wind
uniform float gale; // displacement of the longest fur by the wind alone
uniform float gusts; // strength of gusts, 0..1
uniform vec4 waves[WAVES]; // XYZ = turns per unit, W = phase in turns
uniform vec4 kick[3]; // rows: (position, 1) → velocity added by the skin's motion, 1/s
uniform float fade; // factor of the offsets

layout(location = 0) out vec4 displacement;
layout(location = 1) out vec4 velocity;

ivec2 texel(int i) {
	return ivec2(i % ROW, i / ROW);
}

vec3 tangential(vec3 vector, vec3 normal) {
	return vector - dot(vector, normal) * normal;
}

float wave(vec4 turns, vec3 place) {
	float phase = dot(turns.xyz, place) + turns.w;
	phase -= floor(phase + 0.5);
	return phase * (8.0 - 16.0 * abs(phase));
}

vec3 wind(vec3 place, vec3 normal) {
	float facing = 0.5 + 0.5 * dot(normal, blow);
	float force = gale * (1.0 - LEE * facing * facing);
	float gust = STRENGTH0 * wave(waves[0], place) + STRENGTH1 * wave(waves[1], place) + STRENGTH2 * wave(waves[2], place);
	float veer = VEER * gusts * force * wave(waves[3], place);
	return force * (1.0 + GUST * gusts * gust) * blow + veer * cross(normal, blow);
}

void main() {
	ivec2 at = ivec2(gl_FragCoord.xy);
	int i = at.y * ROW + at.x;
	if (i >= count) discard;
	vec4 place = texelFetch(places, at, 0);
	vec4 outward = texelFetch(normals, at, 0);
	vec4 comb = texelFetch(combs, at, 0);

	vec3 lead = place.w * tangential(sag + wind(place.xyz, outward.xyz), outward.xyz);
	lead += fade * texelFetch(offsets, at, 0).xyz;
	vec3 tip = comb.xyz + lead;
	lead -= max(1.0 - LIMIT / max(length(tip), 1e-6), 0.0) * tip;

	vec3 x = vec3(0.0), v = vec3(0.0);
	float own = 1.0;
	int first = int(outward.w), end = first + int(comb.w);
	for (int l = first; l < end; l++) {
		vec2 link = texelFetch(links, texel(l), 0).xy;
		ivec2 other = texel(int(link.x));
		own -= link.y;
		x += link.y * texelFetch(displacements, other, 0).xyz;
		v += link.y * texelFetch(velocities, other, 0).xyz;
	}
	x = tangential(x + own * texelFetch(displacements, at, 0).xyz, outward.xyz);
	v = tangential(v + own * texelFetch(velocities, at, 0).xyz, outward.xyz);

	vec4 p = vec4(place.xyz, 1.0);
	vec3 push = 0.5 * place.w * tangential(vec3(dot(kick[0], p), dot(kick[1], p), dot(kick[2], p)), outward.xyz);
	v += push;
	tip = comb.xyz + lead + spring.x * (x - lead) + spring.y * v;
	v = spring.z * (x - lead) + spring.w * v + push;
	float far = length(tip);
	if (far > LIMIT) {
		vec3 away = tip / far;
		tip = LIMIT * away;
		v -= max(dot(v, away), 0.0) * away;
	}
	displacement = vec4(tip - comb.xyz, 0.0);
	velocity = vec4(v * min(fastest / max(length(v), 1e-6), 1.0), 0.0);
}
