// Light of the environment: order-2 harmonics of the radiance → light moments.

// Share of light from any direction for the eye, before the bound MIN_SEEN.
Quadratic seenByEye(FurPoint point, Eye from) {
	Quadratic seen = Quadratic(1.0, vec3(0.0), mat3(0.0));
#ifdef EYE
	vec3 level = from.level, leaning = leanTS(), upright = vec3(0.0);
	upright.UP = 1.0;
	float q = from.q, p = from.p, s = point.s / furTrim;
	vec4 first = ofFur(eye, 12, 0) + s * (ofFur(eye, 12, 4) + s * ofFur(eye, 12, 8));
	vec4 second = ofFur(eye, 12, 1) + s * (ofFur(eye, 12, 5) + s * ofFur(eye, 12, 9));
	vec4 third = ofFur(eye, 12, 2) + s * (ofFur(eye, 12, 6) + s * ofFur(eye, 12, 10));
	vec4 last = ofFur(eye, 12, 3) + s * (ofFur(eye, 12, 7) + s * ofFur(eye, 12, 11));
	seen.even += first.x * q + second.z * p + third.y * q * p + from.more;
	seen.gradient = from.rise + first.y * level + (first.z * q + first.w * p + last.w * q * p) * leaning + (second.x * q + last.y * p) * upright;
	seen.form = outerProduct(second.w * level + (third.x * p + third.w * q) * leaning + last.x * upright, level);
	// Lamps all around have two thirds of the factor between hairs that lean.
	seen.form += outerProduct((q * second.y + 0.19 * leanSeen(from, radiusTowards(point, leaning))) * leaning + q * third.z * upright, leaning) + outerProduct(last.z * q * upright, upright);
#endif
	return seen;
}

// lightTS: not below the horizon.
float heldNap(Quadratic seen, vec3 lightTS) {
#ifdef EYE
	return max(quadratic(seen, lightTS), MIN_SEEN);
#else
	return 1.0;
#endif
}

// Change of moments of the polynomials (u², v², uv) and (u, v, 1), and for other curves than a PTM's (w, uw, vw).
struct Change {
	mat3 square;
	mat3 plain;
	mat3 steep;
};

// Adds light from one direction, z up. mean: mean factor of all light.
void addFrom(inout Change change, Radiance radiance, Bending bending, Quadratic seen, float mean, vec3 at) {
#ifdef FIN
	at = at.xzy;
#endif
	vec3 light = radiance.constant + radiance.gradient * at;
	light += vec3(dot(at, radiance.form[0] * at), dot(at, radiance.form[1] * at), dot(at, radiance.form[2] * at));
	light *= 0.25 * PI;
	vec3 way = at;
	float gain = bending.there ? bentLight(way, bending) : 1.0;
	gain *= heldNap(seen, way);
	change.square += outerProduct(light, gain * way.xyx * way.xyy - mean * at.xyx * at.xyy);
	change.plain += outerProduct(light, gain * vec3(way.xy, 1.0) - mean * vec3(at.xy, 1.0));
#ifdef POLYNOMIALS
	change.steep += outerProduct(light, gain * way.z * vec3(1.0, way.xy) - mean * at.z * vec3(1.0, at.xy));
#endif
}

// Adds the change of light from above by bending and eye, ∫R·(factor·φ(sheared ω) − mean·φ(ω))dω, by a sum over eight
// directions: exact for fur as baked and seen from above, 1 to 2 % of the light off where tips are displaced by half of their
// length.
void addChange(inout Moments moments, FurPoint point, Radiance radiance, Bending bending, Quadratic seen, float mean) {
	Change change = Change(mat3(0.0), mat3(0.0), mat3(0.0));
	// Two Gauss-Legendre heights, four azimuths each. Unrolled: a loop costs a software rasteriser 6 % of the frame.
	addFrom(change, radiance, bending, seen, mean, vec3(0.97741619, 0.0, 0.21132487));
	addFrom(change, radiance, bending, seen, mean, vec3(-0.97741619, 0.0, 0.21132487));
	addFrom(change, radiance, bending, seen, mean, vec3(0.0, 0.97741619, 0.21132487));
	addFrom(change, radiance, bending, seen, mean, vec3(0.0, -0.97741619, 0.21132487));
	addFrom(change, radiance, bending, seen, mean, vec3(0.43473824, 0.43473824, 0.78867513));
	addFrom(change, radiance, bending, seen, mean, vec3(-0.43473824, 0.43473824, 0.78867513));
	addFrom(change, radiance, bending, seen, mean, vec3(-0.43473824, -0.43473824, 0.78867513));
	addFrom(change, radiance, bending, seen, mean, vec3(0.43473824, -0.43473824, 0.78867513));
#ifdef POLYNOMIALS
	moments.low += change.square * POLYNOMIAL_LOW(0) + change.plain * POLYNOMIAL_LOW(1) + change.steep * POLYNOMIAL_LOW(2);
#ifdef TWO_PLANES
	moments.high += change.square * POLYNOMIAL_HIGH(0) + change.plain * POLYNOMIAL_HIGH(1) + change.steep * POLYNOMIAL_HIGH(2);
#endif
#else
	moments.low += change.square;
	moments.high += change.plain;
#endif
}

#ifdef EYE
// Factor of the sky's light for the eye: X = mean over the half sphere above, weighted by n·ω and by the constant and the
// gradient of the radiance's luminance; Y = with the surge beside the eye.
vec2 seenSky(FurPoint point, Eye from, Quadratic seen, Radiance around) {
	float c = dot(LUMINANCE, around.constant);
	vec3 g = LUMINANCE * around.gradient, upright = vec3(0.0);
	upright.UP = 1.0;
	g *= min(1.0, max(c, 0.0) / max(length(g), 1e-6)); // radiance is never below 0
	float rise = g.UP, total = max(c + 2.0 / 3.0 * rise, 1e-6);
	// ∫ω and ∫ωωᵀ over π.
	vec3 first = 0.25 * g + (2.0 / 3.0 * c + 0.25 * rise) * upright;
	mat3 second = mat3(0.25 * c + 2.0 / 15.0 * rise) + outerProduct(upright, 0.25 * c * upright + 2.0 / 15.0 * g) + outerProduct(2.0 / 15.0 * g, upright);
	mat3 weighted = matrixCompMult(seen.form, second);
	float sum = dot(seen.gradient, first) + dot(weighted[0] + weighted[1] + weighted[2], vec3(1.0));
	float mean = max(seen.even + sum / total, MIN_SEEN);
	// The narrow surge takes only radiance beside the eye, over the half sphere's mean.
	vec3 viewer = viewerVS(point.pointVS) * point.frameVS;
	viewer.UP = max(viewer.UP, 0.0);
	viewer /= max(length(viewer), 1e-4);
	float beside = max(c + dot(g, viewer), 0.0) / max(c + 0.5 * rise, 1e-6);
	// Share of the half sphere: as hairs are shorter, the surge spreads to all of it.
	float wide = furSurge.w / mix(furSurge.w, 1.0, point.share);
	return vec2(mean, mean + surgeFrom(from.up) * wide * mix(beside * heldNap(seen, viewer), mean, 1.0 - point.share));
}
#endif

// Light of the sky at a point, before the colour of light that has met several hairs.
struct Sky {
	SkyLight light;
	float nap; // share for the eye
	float place; // see skyPlace
};

// Moments of the radiance R(ω) = Σ_j radiance[j]·Y_j(ω) in the tangent frame (columns T, B, N), from three's ambient,
// hemisphere and probe lights.
Sky skyAt(FurPoint point, Bending bending) {
	Eye from = eyeAt(point, bending);
	Quadratic seen = seenByEye(point, from);
	Moments moments;
	float place = skyPlace(point), nap = 1.0;
	mat3 frameVS = point.frameVS;
	const float Y0 = 0.28209479, Y1 = 0.48860251;
	vec3 constant = ambientLightColor;
	mat3 gradient = mat3(0.0); // column per axis of the tangent frame: the radiance's gradient along it
#if NUM_HEMI_LIGHTS > 0
	for (int i = 0; i < NUM_HEMI_LIGHTS; i++) {
		vec3 sky = hemisphereLights[i].skyColor, ground = hemisphereLights[i].groundColor;
		constant += 0.5 * (sky + ground);
		// A gradient g of radiance gives ⅔·g of irradiance, the unit of three's light.
		gradient += outerProduct(0.75 * (sky - ground), hemisphereLights[i].direction * frameVS);
	}
#endif
	gradient *= RECIPROCAL_PI / Y1;
	mat4x3 radiance = mat4x3(constant * (RECIPROCAL_PI / Y0), gradient[1], gradient[2], gradient[0]);
	mat3 form[3] = mat3[3](mat3(0.0), mat3(0.0), mat3(0.0));
#ifdef USE_LIGHT_PROBES
	// The probe's harmonics are in world axes. Order 1 rotates as a vector, order 2 as a traceless quadratic form.
	const float C1 = 1.09254843, C2 = 0.31539157;
	mat3 frameWS = transpose(mat3(viewMatrix)) * frameVS;
	mat3 turned = mat3(lightProbe[3], lightProbe[1], lightProbe[2]) * frameWS;
	radiance += mat4x3(lightProbe[0], turned[1], turned[2], turned[0]);
	mat3x4 order2;
	vec3 last;
	for (int channel = 0; channel < 3; channel++) {
		float zz = 2.0 * C2 * lightProbe[6][channel], d = 0.5 * C1 * lightProbe[8][channel];
		vec3 mixed = 0.5 * C1 * vec3(lightProbe[4][channel], lightProbe[5][channel], lightProbe[7][channel]); // xy, yz, xz
		mat3 world = mat3(d - 0.5 * zz, mixed.x, mixed.z, mixed.x, -d - 0.5 * zz, mixed.y, mixed.z, mixed.y, zz);
		mat3 q = transpose(frameWS) * world * frameWS;
		form[channel] = q;
		order2[channel] = vec4(2.0 * q[0][1] / C1, 2.0 * q[1][2] / C1, q[2][2] / (2.0 * C2), 2.0 * q[0][2] / C1);
		last[channel] = (q[0][0] - q[1][1]) / C1;
	}
#endif
	moments.low = radiance * ENVIRONMENT_LOW0;
#ifdef TWO_PLANES
	moments.high = radiance * ENVIRONMENT_HIGH0;
#else
	moments.high = mat3(0.0);
#endif
#ifdef USE_LIGHT_PROBES
	moments.low += transpose(order2) * ENVIRONMENT_LOW1 + outerProduct(last, ENVIRONMENT_LOW2);
#ifdef TWO_PLANES
	moments.high += transpose(order2) * ENVIRONMENT_HIGH1 + outerProduct(last, ENVIRONMENT_HIGH2);
#endif
#endif
	Radiance around = Radiance(Y0 * radiance[0], Y1 * mat3(radiance[3], radiance[1], radiance[2]), form);
#ifndef MEAN_CURVES
	addDip(moments, point, around, bending);
#endif
#ifdef EYE
	vec2 mean = seenSky(point, from, seen, around);
	nap = mean.y;
	moments.low *= mean.x;
	moments.high *= mean.x;
	addChange(moments, point, around, bending, seen, mean.x);
	moments.low *= mean.y / mean.x;
	moments.high *= mean.y / mean.x;
#else
	if (bending.there) addChange(moments, point, around, bending, seen, 1.0);
#endif
	vec3 low = LUMINANCE * moments.low, high = LUMINANCE * moments.high;
	// The hue of the moments that count most: those of coefficients far from 0.
	vec3 low3 = low * low * low, high3 = high * high * high;
	vec3 hue = (moments.low * low3 + moments.high * high3) / max(dot(low, low3) + dot(high, high3), 1e-24);
	return Sky(SkyLight(Strengths(low, high), hue), nap, place);
}

#ifdef MEAN_CURVES
// Response of the slab to an even sky. It varies most from slab to slab; what is left changes slowly.
float evenSky(FurPoint point, float place) {
	return max(ofSky(point, HARMONICS0_LOW, place).x, 1e-6);
}

// Bits of an entry of BodyLight: moments over `even` and nap as halves of a factor, that factor; hue in halves, nap and place.
void packSky(Sky sky, float even, out uvec4 first, out uvec4 second) {
	vec3 low = sky.light.moments.low, high = sky.light.moments.high, hue = sky.light.hue;
	vec3 largest = max(abs(low), abs(high));
	float factor = max(max(largest.x, largest.y), max(largest.z, 1e-30));
	low /= factor;
	high /= factor;
	first = uvec4(packHalf2x16(low.xy), packHalf2x16(vec2(low.z, high.x)), packHalf2x16(high.yz), floatBitsToUint(factor / (even * sky.nap)));
	second = uvec4(packHalf2x16(hue.xy), packHalf2x16(vec2(hue.z, 0.0)), floatBitsToUint(vec2(sky.nap, sky.place)));
}
#endif

#ifdef BODY_LIGHT
// Sky stored at one height, over its `even` and nap.
Sky storedSky(int height) {
	ivec2 texel = bodyTexel(gl_VertexID, NUM_DIR_LIGHTS + height);
	uvec4 first = texelFetch(bodyLight0, texel, 0), second = texelFetch(bodyLight1, texel, 0);
	vec2 between = unpackHalf2x16(first.y), seen = uintBitsToFloat(second.zw);
	float factor = uintBitsToFloat(first.w);
	Strengths moments = Strengths(factor * vec3(unpackHalf2x16(first.x), between.x), factor * vec3(between.y, unpackHalf2x16(first.z)));
	return Sky(SkyLight(moments, vec3(unpackHalf2x16(second.x), unpackHalf2x16(second.y).x)), seen.x, seen.y);
}

// Sky of the point's slab, between two stored ones; its nap at the point itself, off the slab where shells are few.
Sky storedSky(FurPoint point) {
	int last = lastHeight(), below = min(int(point.slab) * last / max(TOP, 1), last - 1);
	Sky sky = storedSky(below), above = storedSky(below + 1);
	int lower = storedSlab(below), upper = storedSlab(below + 1);
	vec2 share = (vec2(point.slab, point.s * float(LAYERS) - 0.5) - float(lower)) / float(max(upper - lower, 1));
	sky.nap = mix(sky.nap, above.nap, share.y);
	float factor = evenSky(point, sky.place) * sky.nap;
	sky.light.moments.low = factor * mix(sky.light.moments.low, above.light.moments.low, share.x);
	sky.light.moments.high = factor * mix(sky.light.moments.high, above.light.moments.high, share.x);
	sky.light.hue = mix(sky.light.hue, above.light.hue, share.x);
	return sky;
}
#endif

SkyLight skyLight(FurPoint point, Bending bending) {
#ifdef BODY_LIGHT
	Sky sky = storedSky(point);
#else
	Sky sky = skyAt(point, bending);
#endif
	SkyLight light = sky.light;
	float gain = shortGain(point);
	light.moments.low *= gain;
	light.moments.high *= gain;
#ifdef MULTIPLE
	light.hue *= skyTinge(point, multipleGain(point), sky.place, sky.nap);
#endif
#ifdef TRIMMED
	light.moments = trimmed(light.moments, point.s);
#endif
	return light;
}
