// Mean curves, format 2.x: mean brightness of a slab under a light from any direction, also below its horizon. A texel's
// light is its coefficients' sum times its slab's curve, a weighted sum of up to four curves shared by all slabs.

uniform sampler2D curveTable; // fur after fur: RGBA = curves; X = 17 knots along the light's height, Y = the part without azimuth at β = 1, 4, 16, then that along the lean
uniform highp sampler2D slabLight; // a row per slab, state after state, in each fur after fur: see below

// Columns of a row. Coefficients 0..2 (low) and 3..5 (high) have a texel each.
#define WEIGHTS 0 // weights of the curves
#define HARMONICS0_LOW 1 // spherical harmonics 0..3 of the radiance → moments
#define HARMONICS0_HIGH 4
#define HARMONICS1_LOW 7 // harmonics 4..7
#define HARMONICS1_HIGH 10
#define HARMONIC2_LOW 13 // harmonic 8, three coefficients; W = share of an even sky's light that has met several hairs
#define HARMONIC2_HIGH 14
#define RADIUS 14 // texels stride of the sky's texels from β = 1 to 4, and from 4 to 16
#define POLYNOMIALS 43 // curve times φ above the horizon as polynomials: three texels each for (u², v², uv), (u, v, 1), (w, uw, vw), low, then high

#define SHARES 61 // XYZ = weights of 1, √lz and 3·(β − 1)/(2·β + 1) in the share of light that has met several hairs
#define ORDERS 62 // X = ρ, ratio of its orders between white hairs; Y = (1 − ρϖ)/ϖ, ϖ of the baked hairs; Z = mean tint
#define HAIRS 63 // RGB = mean colour, for a pelt with a colour plane

vec4 ofRow(int row, int texel) {
	row += furHairs * LAYERS;
#ifdef WET
	int below = stateBelow(vPlace);
	row += below * FURS * LAYERS;
	vec4 drier = texelFetch(slabLight, ivec2(texel, row), 0);
	return mix(drier, texelFetch(slabLight, ivec2(texel, row + FURS * LAYERS), 0), clamp(vPlace - float(below), 0.0, 1.0));
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

// Place of a body among the tables, 0 at β = 1, 1 at 4, 2 at 16: linear in 1/(β + 1) between two of them, which is `share`.
float tablePlace(float share) {
	return clamp((1.0 / 2.0 - share) / (1.0 / 2.0 - 1.0 / 5.0), 0.0, 1.0) + clamp((1.0 / 5.0 - share) / (1.0 / 5.0 - 1.0 / 17.0), 0.0, 1.0);
}

// That place for light from all around, by the principal curvatures: mean over directions.
float skyPlace(FurPoint point) {
	vec3 bend = point.curvature;
	float mean = 0.5 * (bend.x + bend.y), apart = length(vec2(0.5 * (bend.x - bend.y), bend.z));
	vec2 bends = clamp(vec2(mean + apart, mean - apart), 1.0 / 16.0, 1.0);
	return tablePlace(0.5 * dot(bends / (1.0 + bends), vec2(1.0)));
}

vec4 ofSky(FurPoint point, int texel, float place) {
	int smaller = int(min(place, 1.0));
	texel += RADIUS * smaller;
	return mix(ofSlab(point, texel), ofSlab(point, texel + RADIUS), place - float(smaller));
}

#define ENVIRONMENT(texel) mat3x4(ofSky(point, texel, place), ofSky(point, texel + 1, place), ofSky(point, texel + 2, place))
#define ENVIRONMENT_LOW0 ENVIRONMENT(HARMONICS0_LOW)
#define ENVIRONMENT_HIGH0 ENVIRONMENT(HARMONICS0_HIGH)
#define ENVIRONMENT_LOW1 ENVIRONMENT(HARMONICS1_LOW)
#define ENVIRONMENT_HIGH1 ENVIRONMENT(HARMONICS1_HIGH)
#define ENVIRONMENT_LOW2 ofSky(point, HARMONIC2_LOW, place).xyz
#define ENVIRONMENT_HIGH2 ofSky(point, HARMONIC2_HIGH, place).xyz
#define POLYNOMIAL_LOW(part) threeOfSlab(point, POLYNOMIALS + 3 * part)
#define POLYNOMIAL_HIGH(part) threeOfSlab(point, POLYNOMIALS + 9 + 3 * part)

// β of the body towards a light (Euler's formula), lengths of the hair; the mean of all azimuths for an upright light.
float radiusTowards(FurPoint point, vec3 lightTS) {
	vec2 way = vec2(lightTS.x, lightTS[LEVEL]);
	vec3 bend = point.curvature;
	float level = dot(way, way), mean = 0.5 * (bend.x + bend.y);
	float towards = bend.x * way.x * way.x + bend.y * way.y * way.y + 2.0 * bend.z * way.x * way.y;
	return 1.0 / clamp((towards + 1e-3 * mean) / (level + 1e-3), 1.0 / 16.0, 1.0);
}

// Dip of the horizon at the hair's tip: −sin of the lowest visible elevation.
float horizonDip(FurPoint point, float radius) {
	return sqrt(2.0 * radius + 1.0) / (radius + 1.0);
}

// Mean curves under a light. height: light over the horizon, −1..1. left: see horizonShare. lightTS: clamped to the horizon.
vec4 curvesAt(float height, float left, float radius, vec3 lightTS) {
	float x = height < 0.0 ? 6.0 * left : 6.0 + 10.0 * sqrt(height);
	vec2 at = vec2((x + 0.5) / 17.0, tablePlace(1.0 / (radius + 1.0)) + 0.5);
#ifdef FIN
	float along = leanTS().x * lightTS.x; // a fin's texels count light from both sides of the fur alike
#else
	float along = dot(leanTS(), lightTS);
#endif
	at.y += 6.0 * float(furHairs);
	return texture(curveTable, at / vec2(1.0, 6.0 * float(FURS))) + along * texture(curveTable, vec2(at.x, (at.y + 3.0) / (6.0 * float(FURS))));
}

// Factor of Σ a·φ of the slab's texels; may be slightly below 0 where nearly dark, which keeps it linear.
float meanLight(FurPoint point, vec4 curves) {
	return shortGain(point) * dot(ofSlab(point, WEIGHTS), curves);
}

#ifdef MULTIPLE
#define PRESSED vec2(0.2, 0.5) // see pressedShare, as in pelt/multiple.py

// Mean colour of the slab's hairs at a point, defined by each material. tint: mean of its texels.
vec3 slabColour(FurPoint point, float tint);

// g: light that has met several hairs of this colour, over that between the samples' grey ones. By the law of pelt/multiple.py.
vec3 multipleGain(FurPoint point) {
	vec4 orders = ofSlab(point, ORDERS);
	vec3 colour = min(slabColour(point, orders.z), 0.98);
	return orders.y * colour / (1.0 - orders.x * colour);
}

// Factor of the share of light that has met several hairs, where hairs are shorter. height: light over the horizon, at least 0
float pressedShare(FurPoint point, float height) {
	return 1.0 + (1.0 - point.share * point.share) * (PRESSED.x - PRESSED.y * sqrt(height));
}

// Factor of a lamp's light for the hairs' colour, by the law and with the numbers of pelt/multiple.py. nap: factor of the
// light for the eye
vec3 lampTinge(FurPoint point, vec3 gain, Arrival at, vec3 lightVS, float nap) {
	float height = at.lightTS.UP, opposite = max(-dot(viewerVS(point.pointVS), lightVS), 0.0);
	vec3 terms = vec3(1.0, sqrt(height), 3.0 * (at.radius - 1.0) / (2.0 * at.radius + 1.0));
	float share = dot(ofSlab(point, SHARES).xyz, terms) * pressedShare(point, height) / at.surge;
	share *= exp(min(0.66 * length(lean), 0.33) * (dot(leanTS(), at.lightTS) + 1.1 * opposite) + 0.35 * opposite + 0.03);
#ifdef EYE
	share *= pow(nap, -1.5);
#endif
	return mix(vec3(1.0), gain, clamp(share, 0.0, 1.0));
}

// Factor of the sky's light, whose mean height is ⅔. place: see skyPlace
vec3 skyTinge(FurPoint point, vec3 gain, float place, float nap) {
	float share = ofSky(point, HARMONIC2_LOW, place).w * pressedShare(point, 2.0 / 3.0) / nap;
	return mix(vec3(1.0), gain, min(share, 1.0));
}
#endif
