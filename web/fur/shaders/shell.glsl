// A vertex of a shell: where it stands, which texels it shows, and how much fur it stands for.

in vec4 tangent;
// The value of an attribute that the mesh lacks is kept by location, for all programs together: each has one of its own.
layout(location = 12) in vec4 color; // of the skin, linear
layout(location = 13) in vec4 _fur; // X = lapped weight, Y = share of the longest fur, Z = openness to the sky, W = from tip to tip2, all 0..1
layout(location = 14) in vec3 _comb; // displacement of the tip in the tangent plane, share of the length, the mesh's own axes

#ifdef BODIES
in vec2 bodyDetail; // per instance: X = shells of this body, no more than shellCount; Y = its alphaCut

out float vShells;
out float vCut;
#endif

uniform float tiles; // texture coordinates → tiles
uniform float shellCount; // n, of one body, or the most that one of many has; may lie between two whole numbers
uniform int firstShell; // that is drawn
uniform vec4 drift[(LAYERS + 2) / 2]; // two knots each: mean displacement of the hairs at the root and in every slab's middle, tile widths

out vec3 vAt; // XY = tiles, Z = slab
out float vWeight; // slabs that the shell stands for, of the patch's share
out float vFacing; // n·v

#define NUDGE 1e-4 // slabs, over what rounding does to heights where two meet

#define SLABS (furTrim * float(LAYERS)) // that are left
#ifdef TRIMMED
#define TOP (int(ceil(SLABS - NUDGE)) - 1) // the uppermost of them
#else
#define TOP (LAYERS - 1)
#endif

struct ShellPoint {
	bool there; // whether the body has this shell
	float s; // 0 at the skin, 1 at the tip
	vec3 normal; // of the skin, the mesh's own axes
	mat3 turn; // the mesh's own axes → view space, without scale
	mat3 frameVS; // (T, B, N)
	vec3 comb; // displacement of the tip in that frame, share of the length
	vec3 pointVS;
};

vec2 driftKnot(int k) {
	vec4 two = drift[k >> 1];
	return (k & 1) == 0 ? two.xy : two.zw;
}

// Mean displacement of the hairs: 0 at the root, linear between slab middles and on beyond the last.
vec2 driftAt(float s) {
	float x = s * float(LAYERS) + 0.5;
	if (x < 1.0 || LAYERS == 1) return driftKnot(1) * (2.0 * x - 1.0);
	int k = min(int(x), LAYERS - 1);
	return mix(driftKnot(k), driftKnot(k + 1), x - float(k));
}

// Slab that shell `i` of `count` shows at height s.
int slabAt(float s, float i, float count) {
	// Where shells are fewer and two slabs as near, which of them it is differs from shell to shell: all at once would be
	// seen when their number changes.
	float nudge = count < SLABS ? 0.4 * (fract(0.618034 * i) - 0.5) : NUDGE;
	return clamp(int(s * float(LAYERS) + nudge), 0, TOP);
}

// How many shells stand for a slab, the outermost counted by its share; all slabs weigh the same, or fur would change
// its colour with the number of shells.
float sharesOf(int slab, float count) {
	float each = count / SLABS;
	if (each < 1.0) return each;
	float first = ceil((float(slab) - NUDGE) * each - 0.5), next = ceil((float(slab + 1) - NUDGE) * each - 0.5);
#ifdef TRIMMED
	// The last slab may be cut so thin that no shell shows it, or the outermost shell alone.
	return slab == TOP ? (count - first) / min(SLABS - float(slab), 1.0) : min(next, count) - first;
#else
	return slab == TOP ? count - first : next - first;
#endif
}

// Places the vertex and writes what every fragment of a shell needs, whatever it is lit by.
ShellPoint shellPoint() {
	feelWeather();
	ShellPoint point;
#ifdef BODIES
	float i = float(firstShell + gl_InstanceID % int(ceil(shellCount))), count = bodyDetail.x;
	vShells = bodyDetail.x;
	vCut = bodyDetail.y;
#else
	float i = float(firstShell + gl_InstanceID), count = shellCount;
#endif
	point.there = i < count;
	// Shells lie in the middle of their share of the fur; the outermost has a smaller one where n is no whole number.
	float share = clamp(count - i, 0.0, 1.0);
	point.s = furTrim * min((i + 0.5 * share) / count, 1.0);
	vec3 n = normalize(normal);
	vec3 t = normalize(tangent.xyz - n * dot(n, tangent.xyz));
	mat4 placement = bodyModelView();
	point.normal = n;
	point.turn = mat3(placement) / length(placement[0].xyz);
	vec3 comb = furComb(_comb);
	mat3 frame = mat3(t, tangent.w * cross(n, t), n);
	point.frameVS = point.turn * frame;
	point.comb = comb * frame;
	point.pointVS = (placement * vec4(furPoint(position, n, comb, _fur.y, point.s), 1.0)).xyz;

	// A shell between two slabs' middles shows its slab sheared by how far the hairs have drifted since, so that they run
	// on instead of standing in steps.
#ifdef TRIMMED
	// Where the outermost shell would lie if it were whole: so shares are counted.
	int slab = slabAt(count < SLABS ? point.s : furTrim * min((i + 0.5) / count, 1.0), i, count);
#else
	int slab = slabAt(point.s, i, count);
#endif
	vAt = vec3(uv * tiles - (driftAt(point.s) - driftKnot(slab + 1)), float(slab));
	vWeight = _fur.x * share / sharesOf(slab, count);
	vFacing = dot(point.turn * n, viewerVS(point.pointVS));
	gl_Position = point.there ? projectionMatrix * vec4(point.pointVS, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
	return point;
}
