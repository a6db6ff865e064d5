// Light of the environment: order-2 harmonics of the radiance → light moments.

// Spherical harmonics of the radiance → moments, for coefficients 0..2 (low) and 3..5 (high): a column per coefficient,
// the fourth unused (three sends square matrices only).
uniform mat4 environmentLow0; // harmonics 0..3
uniform mat4 environmentHigh0;
#ifdef USE_LIGHT_PROBES
uniform mat4 environmentLow1; // harmonics 4..7
uniform mat4 environmentHigh1;
uniform vec3 environmentLow2; // harmonic 8
uniform vec3 environmentHigh2;
#endif

// ∫φ(ψ)·h(ψ)dψ around the horizon for h = 1, cos ψ, sin ψ, cos 2ψ, sin 2ψ; ψ grows from the frame's first axis to its other
// level one.
uniform vec3 horizonLow[5];
uniform vec3 horizonHigh[5];

#ifdef CURVES // curves 0..2 and 3..5 as polynomials: a column each, matrices for (u², v², uv), (u, v, 1), (w, uw, vw)
uniform mat3 polynomialLow[3];
#ifdef TWO_PLANES
uniform mat3 polynomialHigh[3];
#endif
#endif

// R = constant + gradient·ω + ωᵀ·form·ω in the tangent frame.
struct Radiance {
	vec3 constant;
	mat3 gradient; // a column per axis
	mat3 form[3]; // traceless, one for each channel
};

// A product around the horizon: light times what bent fur makes of it, in the harmonics of horizonLow.
vec3[5] bentRing(vec3 light[5], Bending bending) {
	mat3 q = bending.form;
	float even = bending.even + 0.5 * (q[0][0] + q[LEVEL][LEVEL]), x = bending.gradient[0], y = bending.gradient[LEVEL];
	float xx = 0.5 * (q[0][0] - q[LEVEL][LEVEL]), xy = 0.5 * (q[0][LEVEL] + q[LEVEL][0]);
	return vec3[5](
		even * light[0] + 0.5 * (x * light[1] + y * light[2] + xx * light[3] + xy * light[4]),
		even * light[1] + x * light[0] + 0.5 * (x * light[3] + y * light[4] + xx * light[1] + xy * light[2]),
		even * light[2] + y * light[0] + 0.5 * (x * light[4] - y * light[3] - xx * light[2] + xy * light[1]),
		even * light[3] + xx * light[0] + 0.5 * (x * light[1] - y * light[2]),
		even * light[4] + xy * light[0] + 0.5 * (x * light[2] + y * light[1])
	);
}

// Light from below the horizon is held on it and fades as a lamp's does: Σ_h horizon[h]·∫√(1 + z/dip)·(R's part in h)dz.
void addDip(inout Moments moments, Radiance radiance, Bending bending, float s) {
	float dip = horizonDip(s);
	// ∫√(1 + z/dip)·{1, z, z²}dz over −dip..0; times √(1 − z²) to its second term.
	float i0 = 2.0 / 3.0 * dip, i1 = -4.0 / 15.0 * dip * dip, i2 = 16.0 / 105.0 * dip * dip * dip;
	float level0 = i0 - 0.5 * i2, level1 = i1 + 16.0 / 315.0 * dip * dip * dip * dip;
	mat3 gradient = radiance.gradient;
	vec3 ring[5] = vec3[5](radiance.constant * i0 + gradient[UPRIGHT] * i1, gradient[0] * level0, gradient[LEVEL] * level0, vec3(0.0), vec3(0.0));
	for (int c = 0; c < 3; c++) {
		mat3 q = radiance.form[c];
		ring[0][c] += q[UPRIGHT][UPRIGHT] * (1.5 * i2 - 0.5 * i0);
		ring[1][c] += 2.0 * q[0][UPRIGHT] * level1;
		ring[2][c] += 2.0 * q[LEVEL][UPRIGHT] * level1;
		ring[3][c] = 0.5 * (q[0][0] - q[LEVEL][LEVEL]) * (i0 - i2);
		ring[4][c] = q[0][LEVEL] * (i0 - i2);
	}
	if (bending.there) ring = bentRing(ring, bending);
	for (int h = 0; h < 5; h++) {
		moments.low += outerProduct(ring[h], horizonLow[h]);
		moments.high += outerProduct(ring[h], horizonHigh[h]);
	}
}

// Change of moments, of a PTM's polynomials (u², v², uv) and (u, v, 1), and for other curves of (w, uw, vw).
struct Change {
	mat3 square;
	mat3 plain;
	mat3 steep;
};

// What comes from one direction, z up.
void addFrom(inout Change change, Radiance radiance, Bending bending, vec3 at) {
#ifdef FIN
	at = at.xzy;
#endif
	vec3 light = radiance.constant + radiance.gradient * at;
	light += vec3(dot(at, radiance.form[0] * at), dot(at, radiance.form[1] * at), dot(at, radiance.form[2] * at));
	light *= 0.25 * PI;
	vec3 way = at;
	float gain = bentLight(way, bending);
	change.square += outerProduct(light, gain * way.xyx * way.xyy - at.xyx * at.xyy);
	change.plain += outerProduct(light, gain * vec3(way.xy, 1.0) - vec3(at.xy, 1.0));
#ifdef CURVES
	change.steep += outerProduct(light, gain * way.z * vec3(1.0, way.xy) - at.z * vec3(1.0, at.xy));
#endif
}

// What bending changes of the light from above, ∫R·(factor·φ(sheared ω) − φ(ω))dω, by a sum over eight directions: exact
// where fur stands as it was baked, 1 to 2 % of the light off where its tips are displaced by half of their length.
void addBent(inout Moments moments, Radiance radiance, Bending bending) {
	Change change = Change(mat3(0.0), mat3(0.0), mat3(0.0));
	// Two heights of Gauss and Legendre's, four spokes each. Written out: a loop costs a software rasteriser 6 % of the frame.
	addFrom(change, radiance, bending, vec3(0.97741619, 0.0, 0.21132487));
	addFrom(change, radiance, bending, vec3(-0.97741619, 0.0, 0.21132487));
	addFrom(change, radiance, bending, vec3(0.0, 0.97741619, 0.21132487));
	addFrom(change, radiance, bending, vec3(0.0, -0.97741619, 0.21132487));
	addFrom(change, radiance, bending, vec3(0.43473824, 0.43473824, 0.78867513));
	addFrom(change, radiance, bending, vec3(-0.43473824, 0.43473824, 0.78867513));
	addFrom(change, radiance, bending, vec3(-0.43473824, -0.43473824, 0.78867513));
	addFrom(change, radiance, bending, vec3(0.43473824, -0.43473824, 0.78867513));
#ifdef CURVES
	moments.low += change.square * polynomialLow[0] + change.plain * polynomialLow[1] + change.steep * polynomialLow[2];
#ifdef TWO_PLANES
	moments.high += change.square * polynomialHigh[0] + change.plain * polynomialHigh[1] + change.steep * polynomialHigh[2];
#endif
#else
	moments.low += change.square;
	moments.high += change.plain;
#endif
}

// Moments of the radiance R(ω) = Σ_j radiance[j]·Y_j(ω) in the tangent frame (columns T, B, N), from three's ambient,
// hemisphere and probe lights.
Moments environmentMoments(FurPoint point, Bending bending) {
	Moments moments;
	mat3 frameVS = point.frameVS;
	const float Y0 = 0.28209479, Y1 = 0.48860251;
	vec3 constant = ambientLightColor;
	mat3 gradient = mat3(0.0); // column per axis of the tangent frame: how the radiance grows along it
#if NUM_HEMI_LIGHTS > 0
	for (int i = 0; i < NUM_HEMI_LIGHTS; i++) {
		vec3 sky = hemisphereLights[i].skyColor, ground = hemisphereLights[i].groundColor;
		constant += 0.5 * (sky + ground);
		// A gradient g of radiance makes one of ⅔·g of irradiance, which is what three's light has.
		gradient += outerProduct(0.75 * (sky - ground), hemisphereLights[i].direction * frameVS);
	}
#endif
	gradient *= RECIPROCAL_PI / Y1;
	mat4x3 radiance = mat4x3(constant * (RECIPROCAL_PI / Y0), gradient[1], gradient[2], gradient[0]);
	mat3 form[3] = mat3[3](mat3(0.0), mat3(0.0), mat3(0.0));
#ifdef USE_LIGHT_PROBES
	// The probe's harmonics belong to world axes. Order 1 turns as a vector, order 2 as a traceless quadratic form.
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
	moments.low = radiance * mat3x4(environmentLow0);
	moments.high = radiance * mat3x4(environmentHigh0);
#ifdef USE_LIGHT_PROBES
	moments.low += transpose(order2) * mat3x4(environmentLow1) + outerProduct(last, environmentLow2);
	moments.high += transpose(order2) * mat3x4(environmentHigh1) + outerProduct(last, environmentHigh2);
#endif
	Radiance around = Radiance(Y0 * radiance[0], Y1 * mat3(radiance[3], radiance[1], radiance[2]), form);
	addDip(moments, around, bending, point.s);
	if (bending.there) addBent(moments, around, bending);
#ifdef TRIMMED
	moments = trimmed(moments, point.s);
#endif
	return moments;
}
