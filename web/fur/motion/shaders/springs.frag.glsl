// Sub-step of a follicle's spring, equal to `CpuSprings`; axes of the shells' mesh.

precision highp float;
precision highp int;
precision highp sampler2D;

uniform int count; // number of follicles
uniform sampler2D places; // XYZ = position, W = share of the longest fur
uniform sampler2D normals; // XYZ, W = first link
uniform sampler2D combs; // XYZ = displacement of the tip as combed, share of the length; W = number of links
uniform sampler2D links; // X = neighbour, Y = weight
uniform sampler2D carriers; // four of each follicle: X = joint, Y = weight
uniform sampler2D joints; // JOINT texels each, as `Drive.joints`
uniform sampler2D ways; // XYZ = velocity added to the tips by morph targets, 1/s
uniform bool morphs; // whether there is any
uniform sampler2D offsets; // XYZ = displacement by strokes, before the factor `fade`
uniform sampler2D displacements; // XYZ = displacement at the beginning, shares of the length
uniform sampler2D velocities; // XYZ = velocity at the beginning, 1/s

uniform vec4 spring; // x' = lead + X·(x - lead) + Y·v, v' = Z·(x - lead) + W·v
uniform float fastest; // largest velocity, 1/s
uniform vec3 pull; // displacement of the longest fur by gravity alone, world axes
uniform vec3 laid; // that of the baked pose
uniform vec3 blow; // unit vector along the wind, world axes
uniform float gale; // displacement of the longest fur by the wind alone
uniform float gusts; // strength of gusts, 0..1
uniform vec4 waves[WAVES]; // XYZ = turns per radius of the body, world axes; W = phase in turns
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

// Rows of the matrix (position, 1) → place in radii about the body's centre, world axes, and of that to the velocity added to
// the tips by the skin's motion, 1/s.
struct Motion {
	vec4 place[3];
	vec4 kick[3];
};

Motion motionOf(int follicle) {
	Motion motion = Motion(vec4[3](vec4(0.0), vec4(0.0), vec4(0.0)), vec4[3](vec4(0.0), vec4(0.0), vec4(0.0)));
	for (int c = 0; c < 4; c++) {
		vec2 carrier = texelFetch(carriers, texel(4 * follicle + c), 0).xy;
		if (carrier.y == 0.0) continue;
		int joint = JOINT * int(carrier.x);
		for (int row = 0; row < 3; row++) {
			motion.place[row] += carrier.y * texelFetch(joints, texel(joint + row), 0);
			motion.kick[row] += carrier.y * texelFetch(joints, texel(joint + 3 + row), 0);
		}
	}
	return motion;
}

vec3 moved(vec4 rows[3], vec4 point) {
	return vec3(dot(rows[0], point), dot(rows[1], point), dot(rows[2], point));
}

// Rotation from the world's axes to those at rest: see `Blend`.
mat3 turnOf(vec4 rows[3]) {
	mat3 turn = mat3(rows[0].xyz, rows[1].xyz, rows[2].xyz);
	float square = dot(turn[0], turn[0]) + dot(turn[1], turn[1]) + dot(turn[2], turn[2]);
	turn *= sqrt(3.0 / max(square, 1e-20));
	for (int i = 0; i < STEPS; i++) turn = 1.5 * turn - 0.5 * turn * (transpose(turn) * turn);
	return turn;
}

// place: in radii about the body's centre, world axes.
vec3 wind(vec3 place, vec3 normal, vec3 blow) {
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

	vec4 p = vec4(place.xyz, 1.0);
	Motion motion = motionOf(i);
	mat3 turn = turnOf(motion.place);
	vec3 blown = wind(moved(motion.place, p), outward.xyz, turn * blow);
	vec3 lead = place.w * tangential(turn * pull - laid + blown, outward.xyz);
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

	vec3 kick = turn * moved(motion.kick, p);
	if (morphs) kick += texelFetch(ways, at, 0).xyz;
	vec3 push = 0.5 * place.w * tangential(kick, outward.xyz);
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
