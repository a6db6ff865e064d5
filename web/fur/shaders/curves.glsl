// Mean curves, format 2.x: how bright a slab is on the mean under a light from any direction, below its horizon too. A
// texel's light is its coefficients' sum times its slab's curve, a weighted sum of up to four that all slabs share.

uniform sampler2D curveTable; // RGBA = curves; X = 17 knots along the light's height, Y = the part without azimuth at β = 1, 4, 16, then that along the lean
uniform highp sampler2D slabLight; // a row per slab, of one state after the other: see below

// Texels of a row. Coefficients 0..2 (low) and 3..5 (high) have a texel each.
#define WEIGHTS 0 // of the curves
#define HARMONICS0_LOW 1 // spherical harmonics 0..3 of the radiance → moments
#define HARMONICS0_HIGH 4
#define HARMONICS1_LOW 7 // harmonics 4..7
#define HARMONICS1_HIGH 10
#define HARMONIC2_LOW 13 // harmonic 8, three coefficients; W = share of an even sky's light that has met several hairs
#define HARMONIC2_HIGH 14
#define RADIUS 14 // texels from the sky's of β = 1 to those of 4, and on to those of 16
#define POLYNOMIALS 43 // curve times φ above the horizon as polynomials: three texels each for (u², v², uv), (u, v, 1), (w, uw, vw), low, then high

#define SHARES 61 // XYZ = what 1, √lz and log₄ β count in the share of light that has met several hairs
#define ORDERS 62 // X = ρ, by which its orders shrink between white hairs; Y = (1 − ρϖ)/ϖ, ϖ of the baked ones; Z = mean tint
#define HAIRS 63 // RGB = mean colour, of a pelt with a colour plane

vec4 ofRow(int row, int texel) {
#ifdef WET
	int below = stateBelow(vPlace);
	row += below * LAYERS;
	vec4 drier = texelFetch(slabLight, ivec2(texel, row), 0);
	return mix(drier, texelFetch(slabLight, ivec2(texel, row + LAYERS), 0), clamp(vPlace - float(below), 0.0, 1.0));
#else
	return texelFetch(slabLight, ivec2(texel, row), 0);
#endif
}

vec4 ofSlab(FurPoint point, int texel) {
#ifdef FIN
	int row = int(point.slab);
	return mix(ofRow(row, texel), ofRow(min(row + 1, LAYERS - 1), texel), point.slab - float(row));
#else
	return ofRow(int(point.slab + 0.5), texel);
#endif
}

mat3 threeOfSlab(FurPoint point, int texel) {
	return mat3(ofSlab(point, texel).xyz, ofSlab(point, texel + 1).xyz, ofSlab(point, texel + 2).xyz);
}

// log₄ β of the body for light from all around, by its principal curvatures: the mean of what single lamps go by.
float skyRadius(FurPoint point) {
	vec3 bend = point.curvature;
	float mean = 0.5 * (bend.x + bend.y), apart = length(vec2(0.5 * (bend.x - bend.y), bend.z));
	vec2 roots = sqrt(clamp(vec2(mean + apart, mean - apart), 1.0 / 16.0, 1.0));
	return -log2(0.5 * (roots.x + roots.y));
}

vec4 ofSky(FurPoint point, int texel, float radius) {
	int smaller = int(min(radius, 1.0));
	texel += RADIUS * smaller;
	return mix(ofSlab(point, texel), ofSlab(point, texel + RADIUS), radius - float(smaller));
}

#define ENVIRONMENT(texel) mat3x4(ofSky(point, texel, radius), ofSky(point, texel + 1, radius), ofSky(point, texel + 2, radius))
#define ENVIRONMENT_LOW0 ENVIRONMENT(HARMONICS0_LOW)
#define ENVIRONMENT_HIGH0 ENVIRONMENT(HARMONICS0_HIGH)
#define ENVIRONMENT_LOW1 ENVIRONMENT(HARMONICS1_LOW)
#define ENVIRONMENT_HIGH1 ENVIRONMENT(HARMONICS1_HIGH)
#define ENVIRONMENT_LOW2 ofSky(point, HARMONIC2_LOW, radius).xyz
#define ENVIRONMENT_HIGH2 ofSky(point, HARMONIC2_HIGH, radius).xyz
#define POLYNOMIAL_LOW(part) threeOfSlab(point, POLYNOMIALS + 3 * part)
#define POLYNOMIAL_HIGH(part) threeOfSlab(point, POLYNOMIALS + 9 + 3 * part)

// β of the body towards a light (Euler's formula), in lengths of the hair; the mean of all azimuths where it is upright.
float radiusTowards(FurPoint point, vec3 lightTS) {
	vec2 way = vec2(lightTS.x, lightTS[LEVEL]);
	vec3 bend = point.curvature;
	float level = dot(way, way), mean = 0.5 * (bend.x + bend.y);
	float towards = bend.x * way.x * way.x + bend.y * way.y * way.y + 2.0 * bend.z * way.x * way.y;
	return 1.0 / clamp((towards + 1e-3 * mean) / (level + 1e-3), 1.0 / 16.0, 1.0);
}

// How far below its horizon the hair's tip sees: −sin of that angle's lowest.
float horizonDip(FurPoint point, float radius) {
	return sqrt(2.0 * radius + 1.0) / (radius + 1.0);
}

// What Σ a·φ of the slab's texels is multiplied by; where it is nearly dark a little below 0, so that it stays a sum.
// height: of the light over the horizon, −1..1. fade: share of the dip that is left, 1 above. lightTS: held on the horizon.
float meanLight(FurPoint point, float height, float fade, float radius, vec3 lightTS) {
	float x = height < 0.0 ? 6.0 * fade * fade : 6.0 + 10.0 * sqrt(height);
	vec2 at = vec2((x + 0.5) / 17.0, 0.5 * log2(radius) + 0.5);
#ifdef FIN
	float along = leanTS().x * lightTS.x; // what the lean has across a fin points to either side
#else
	float along = dot(leanTS(), lightTS);
#endif
	vec4 curves = texture(curveTable, at / vec2(1.0, 6.0)) + along * texture(curveTable, vec2(at.x, (at.y + 3.0) / 6.0));
	return dot(ofSlab(point, WEIGHTS), curves);
}

#ifdef MULTIPLE
// Mean colour of the hairs of the slab at a point, each material's own. tint: mean of its texels'.
vec3 slabColour(FurPoint point, float tint);

// g: light that has met several hairs of this colour, over that between the samples' grey ones. Pelt/multiple.py has the law.
vec3 multipleGain(FurPoint point) {
	vec4 orders = ofSlab(point, ORDERS);
	vec3 colour = min(slabColour(point, orders.z), 0.98);
	return orders.y * colour / (1.0 - orders.x * colour);
}

// What a lamp's light is multiplied by for the hairs' colour. height: of the light over the horizon, no less than 0. nap: what
// counts of the light for the eye, nearly all of it by light that has met one hair.
vec3 lampTinge(FurPoint point, vec3 gain, float radius, float height, float nap) {
	vec3 terms = vec3(1.0, sqrt(height), 0.5 * log2(radius));
	return mix(vec3(1.0), gain, clamp(dot(ofSlab(point, SHARES).xyz, terms) / nap, 0.0, 1.0));
}

// The same of the sky's light. radius: as of skyRadius
vec3 skyTinge(FurPoint point, vec3 gain, float radius, float nap) {
	return mix(vec3(1.0), gain, min(ofSky(point, HARMONIC2_LOW, radius).w / nap, 1.0));
}
#endif
