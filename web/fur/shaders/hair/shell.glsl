// Vertex of a shell: its position, its texels, and the thickness of fur that it stands for.

layout(location = 12) in vec4 color; // colour of the skin, linear

#ifdef BODIES
in vec4 bodyDetail; // per instance: X = shells of this body, no more than shellCount; Y = its alphaCut; ZW = its crispness
#define crispness bodyDetail.zw

centroid out float vShells;
flat out uint vDetail; // two halves: alphaCut, X of crispness
#endif

uniform float tiles; // texture coordinates → tiles
uniform float shellCount; // n of one body, or the largest of many; may be fractional
uniform int firstShell; // first shell that is drawn, of those left by merging
#ifndef BODIES
uniform float merged; // how far shells have gone over to those that stand for several: at 1 no others are drawn
uniform vec4 groups; // X = lowest shells, which the last of them stands for, then one stands for each of Y slabs from slab Z on; W = first shell that stands for itself alone
#endif

#define FUR_SLABS (FURS * LAYERS) // slabs of all furs in one state
#ifdef WET
#define CRISP_SLABS (FUR_SLABS * WET)
#else
#define CRISP_SLABS FUR_SLABS
#endif
uniform highp uvec4 crispLevels[(CRISP_SLABS + 1) / 2]; // levels of two slabs each, state after state: X = of texels, Y = of those twice as large; see crisp.ts
#ifndef BODIES
uniform vec2 crispness; // Y = share of the latter in the picture
#endif

out vec3 vAt; // XY = tiles, Z = slab, fur after fur
centroid out float vWeight; // slabs that the shell stands for, times the patch's weight
centroid out float vFacing; // n·v, through the pelt
out float vKept;
#ifdef PARTED
in vec4 regionSlope; // growth of the two bounds along u and v, per unit of texture coordinates: XY of the lower, ZW of the upper
uniform float furCells; // cells along a tile of the coat in which all hairs are of one fur
out vec2 vRoot; // root of the hairs, cells
// Bounds of the numbers of this fur's hairs there.
#if REGIONS == 2
centroid out float vBound; // upper bound of the coat's; of the other's, which are counted from 1 down, too
#else
centroid out float vLowest;
centroid out float vHighest;
#endif
#endif

uniform vec3 spreads[FURS]; // X = spread of the hairs' slopes, 0 where it is not known, Y = length of the longest hairs, widths of the coat's tile; Z = share of the skin seen from above between the hairs

#define DENSE 0.1 // shares of open skin up to which hairs hide it as dust does, and from which on by their slopes
#define SPARSE 0.3
#define ASLANT 0.6 // share of their weight that many shells of one slab lose seen along the skin: they hide the gaps of each other there
#define TIE 0.7 // phase at which half as many shells as slabs are as bright as a few more or less

#define SLABS (furTrim * float(LAYERS)) // slabs left after a cut

struct ShellPoint {
	bool there; // whether the body has this shell
	float s; // 0 at the skin, 1 at the tip
	vec3 normal; // normal of the skin, the mesh's own axes
	mat3 turn; // the mesh's own axes → view space, without scale
	mat3 frameVS; // (T, B, N)
	vec3 comb; // displacement of the tip in that frame, share of the length
	vec3 pointVS;
	int slab;
};

// Slab shown by shell `i` of `count` at height s.
int slabAt(float s, float i, float count) {
	// With fewer shells than slabs, ties between two slabs are broken shell by shell: all shells changing at once would be
	// visible when their number changes.
	float nudge = count < SLABS ? 0.4 * (fract(0.618034 * i + TIE) - 0.5) : NUDGE;
	return clamp(int(s * float(LAYERS) + nudge), 0, TOP);
}

// Numbers of a slab's level, see crisp.ts.
vec2 crispLevel(int slab) {
	uvec4 two = crispLevels[slab >> 1];
	uvec2 level = (slab & 1) == 0 ? two.xy : two.zw;
	return 4.0 * mix(unpackUnorm2x16(level.x), unpackUnorm2x16(level.y), crispness.y);
}

// Coverage of a slab, fur after fur, that crispness leaves alone. slabs: that a ray to the eye crosses in the shell
float keptLevel(int slab, float slabs) {
#ifdef WET
	int below = stateBelow(vPlace);
	vec2 drier = crispLevel(slab + below * FUR_SLABS);
	vec2 level = mix(drier, crispLevel(slab + (below + 1) * FUR_SLABS), clamp(vPlace - float(below), 0.0, 1.0));
#else
	vec2 level = crispLevel(slab);
#endif
	return level.x / (1.0 + level.y * slabs);
}

// First shell of a slab.
float firstOf(int slab, float count) {
	return ceil((float(slab) - NUDGE) * count / SLABS - 0.5);
}

// Shell that stands for a slab's.
float middleOf(int slab, float count) {
	return floor(0.5 * (firstOf(slab, count) + firstOf(slab + 1, count)));
}

// Number of shells of a slab, the outermost counted by its share. It equalises the slabs' weights, or fur would change its
// colour with the number of shells.
float sharesOf(int slab, float count) {
	if (count < SLABS) return count / SLABS;
	float first = firstOf(slab, count), next = firstOf(slab + 1, count);
#ifdef TRIMMED
	// A thin last slab may have no shell, or only the outermost.
	return slab == TOP ? (count - first) / min(SLABS - float(slab), 1.0) : min(next, count) - first;
#else
	return slab == TOP ? count - first : next - first;
#endif
}

// Skin that combed hairs lie along, over that of uncombed ones of this slope seen from straight above; times n·v where they are
// seen from aside. eye: unit vector to the viewer through the pelt, in the frame. See pelt/hairs/shown.py.
float hairCover(ShellPoint point, vec2 own, vec3 eye, float share) {
	vec3 spread = spreads[furHairs];
	if (spread.x <= 0.0) return 1.0;
	float reach = spread.y * _fur.y / furWidth;
#ifdef WET
	reach *= furTraits.x;
#endif
	vec2 more = 2.0 * point.s * reach / max(furRise(point.comb), 0.1) * point.comb.xy;
	vec2 lie = own + more;
	float apart = spread.x * spread.x, before = sqrt(dot(own, own) + apart), cover = sqrt(dot(lie, lie) + apart) / before;
	if (spread.z > 0.0) {
		vec2 across = lie * eye.z - eye.xy * (reach / share * furRise(point.comb));
		float sparse = clamp((pow(spread.z, cover) - DENSE) / (SPARSE - DENSE), 0.0, 1.0);
		cover = mix(cover, max(cover, sqrt(dot(across, across) + apart * eye.z * eye.z) / before), sparse);
	}
	return cover;
}

// Places the vertex and writes varyings that are independent of the light.
ShellPoint shellPoint() {
	takePose();
	feelWeather();
	ShellPoint point;
#ifdef BODIES
	float i = float(firstShell + gl_InstanceID % int(ceil(shellCount))), count = bodyDetail.x;
	vShells = bodyDetail.x;
	vDetail = packHalf2x16(bodyDetail.yz);
#else
	float i = float(firstShell + gl_InstanceID), count = shellCount;
	if (merged == 1.0) {
		float beyond = i - 1.0 - groups.y;
		i = i < 1.0 ? groups.x - 1.0 : beyond < 0.0 ? middleOf(int(groups.z + i) - 1, count) : groups.w + beyond;
	}
#endif
	point.there = i < count;
	// Shells lie in the middle of their share of the fur; a fractional n leaves the outermost a smaller share.
	float share = clamp(count - i, 0.0, 1.0);
	point.s = furTrim * min((i + 0.5 * share) / count, 1.0);
	mat3 frame = skinFrame();
	vec3 n = frame[2];
	mat4 placement = bodyModelView();
	point.normal = n;
	point.turn = mat3(placement) / length(placement[0].xyz);
	vec3 comb = furComb(_comb);
	point.frameVS = point.turn * frame;
	point.comb = comb * frame;

	// A shell off its slab's middle is sheared by the hairs' drift from there, so that hairs are continuous, not stepped.
#ifdef TRIMMED
	// Count shares as if the outermost shell were whole.
	int slab = slabAt(count < SLABS ? point.s : furTrim * min((i + 0.5) / count, 1.0), i, count);
#else
	int slab = slabAt(point.s, i, count);
#endif
	float shells = sharesOf(slab, count), slabs = share / shells;
#ifndef BODIES
	if (i < groups.w) {
		bool lowest = i < groups.x, stands = i == (lowest ? groups.x - 1.0 : middleOf(slab, count));
		shells = mix(shells, 1.0, merged);
		slabs = mix(slabs, !stands ? 0.0 : lowest ? groups.x * SLABS / count : 1.0, merged);
		if (stands && !lowest) point.s = mix(point.s, (float(slab) + 0.5) / float(LAYERS), merged);
	}
#endif
	point.pointVS = (placement * vec4(furPoint(rootPosition, n, comb, _fur.y, point.s), 1.0)).xyz;
	vec2 slope, drifted = driftAt(point.s, slope);
	vAt = vec3(uv * furTiles - (drifted - driftKnot(slab + 1)), float(slab + furRegion * LAYERS));
	point.slab = slab;
	// An eye meets of short hairs what it meets of the pelt's on a steeper way.
	float lengthShare = hairShare(_fur.y);
	vec3 eye = viewerVS(point.pointVS) * point.frameVS;
	eye = normalize(vec3(eye.xy, eye.z / lengthShare));
	vFacing = eye.z;
	slabs *= 1.0 - ASLANT * (1.0 - abs(vFacing)) * (1.0 - 1.0 / max(shells, 1.0));
	slabs *= _fur.x * hairCover(point, slope, eye, lengthShare) * divergence(furCurvature(_fur.y), point.comb, point.s);
	vWeight = slabs * FUR_SHARE;
#ifdef PARTED
	drifted *= furWidth;
	vRoot = (uv * tiles - drifted) * furCells;
	vec2 bounds = _region.xy - vec2(dot(regionSlope.xy, drifted), dot(regionSlope.zw, drifted)) / tiles;
#if REGIONS == 2
	vBound = mix(bounds.y, 1.0 - bounds.x, furSecond);
#else
	vLowest = bounds.x;
	vHighest = bounds.y;
#endif
#endif
	vKept = keptLevel(slab + furHairs * LAYERS, slabs / max(abs(vFacing), 1.0 / MAX_SLANT));
	gl_Position = point.there ? projectionMatrix * vec4(point.pointVS, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
	return point;
}
