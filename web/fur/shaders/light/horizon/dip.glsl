// Light of the environment from below the horizon, format 1.x.

// ∫φ(ψ)·h(ψ)dψ around the horizon for h = 1, cos ψ, sin ψ, cos 2ψ, sin 2ψ; ψ grows from the frame's first level axis to
// the second.
uniform vec3 horizonLow[5];
uniform vec3 horizonHigh[5];

// Product around the horizon of light and the factor of bent fur, in the harmonics of horizonLow.
vec3[5] bentRing(vec3 light[5], Bending bending) {
	mat3 q = bending.factor.form;
	float even = bending.factor.even + 0.5 * (q[0][0] + q[LEVEL][LEVEL]), x = bending.factor.gradient[0], y = bending.factor.gradient[LEVEL];
	float xx = 0.5 * (q[0][0] - q[LEVEL][LEVEL]), xy = 0.5 * (q[0][LEVEL] + q[LEVEL][0]);
	return vec3[5](
		even * light[0] + 0.5 * (x * light[1] + y * light[2] + xx * light[3] + xy * light[4]),
		even * light[1] + x * light[0] + 0.5 * (x * light[3] + y * light[4] + xx * light[1] + xy * light[2]),
		even * light[2] + y * light[0] + 0.5 * (x * light[4] - y * light[3] - xx * light[2] + xy * light[1]),
		even * light[3] + xx * light[0] + 0.5 * (x * light[1] - y * light[2]),
		even * light[4] + xy * light[0] + 0.5 * (x * light[2] + y * light[1])
	);
}

// Adds light from below the horizon, clamped to it and fading as a lamp's: Σ_h horizon[h]·∫√(1 + z/dip)·(R's part in h)dz.
void addDip(inout Moments moments, FurPoint point, Radiance radiance, Bending bending) {
	float dip = horizonDip(point, bodyRadius);
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
