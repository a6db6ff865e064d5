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

// Moments of the radiance R(ω) = Σ_j radiance[j]·Y_j(ω) in the tangent frame (columns T, B, N), from three's ambient,
// hemisphere and probe lights.
Moments environmentMoments(mat3 frameVS) {
	Moments moments;
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
	return moments;
}
