// Light moments: m = Σ over lights of E·φ(l), and of the environment's radiance R, ∫R(ω)·φ(ω)dω over the upper hemisphere.
// A texel's light is then one dot product with its coefficients, whatever the number of lights.
// Needs three's <common> and <lights_pars_begin>; directions are in view space until they enter the tangent frame (TS):
// (T, B, N) of a shell; of a fin (along the edge, N, across it), its φ being of the first two as a shell's.

#ifdef FIN
#define UP y
#else
#define UP z
#endif

// Moments of coefficients 0..2 and 3..5: a column per coefficient, a row per colour channel.
struct Moments {
	mat3 low;
	mat3 high;
};

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
uniform float bodyRadius; // β, in lengths of the fur: where tips lose the light when it sinks below their horizon

#ifdef BASIS_EIGEN // its degree
#define TERMS ((BASIS_EIGEN + 1) * (BASIS_EIGEN + 1) + 2) // smooth functions
uniform vec3 curvesLow[TERMS]; // weights of each smooth function in light curves 0..2 and 3..5
uniform vec3 curvesHigh[TERMS];
#endif

// φ(l) of a light above the horizon. Paper, eq. (2), or smooth light curves.
void basis(vec3 lightTS, out vec3 low, out vec3 high) {
	float u = lightTS.x, v = lightTS.y;
#ifdef BASIS_EIGEN
	low = vec3(0.0);
	high = vec3(0.0);
	int n = 0;
	float w = 1.0;
	for (int k = 0; k < 2; k++) {
		float ui = w;
		for (int i = 0; i + k <= BASIS_EIGEN; i++) {
			float uivj = ui;
			for (int j = 0; i + j + k <= BASIS_EIGEN; j++) {
				low += curvesLow[n] * uivj;
				high += curvesHigh[n] * uivj;
				n++;
				uivj *= v;
			}
			ui *= u;
		}
		w = lightTS.z;
	}
	float root = sqrt(w);
	low += curvesLow[n] * root + curvesLow[n + 1] * sqrt(root);
	high += curvesHigh[n] * root + curvesHigh[n + 1] * sqrt(root);
#else
	low = vec3(u * u, v * v, u * v);
	high = vec3(u, v, 1.0);
#endif
}

// A light below the horizon is held on it and fades out over the dip that a point at height s sees.
float horizon(inout vec3 lightTS, float s) {
	if (lightTS.UP >= 0.0) return 1.0;
	float cosine = bodyRadius / (bodyRadius + s);
	float dip = sqrt(1.0 - cosine * cosine);
	float fade = sqrt(clamp(1.0 + lightTS.UP / max(dip, 1e-4), 0.0, 1.0));
	lightTS.UP = 0.0;
	lightTS /= max(length(lightTS), 1e-4);
	return fade;
}

void addLight(inout Moments moments, mat3 frameVS, float s, vec3 lightVS, vec3 irradiance) {
	vec3 lightTS = lightVS * frameVS;
	irradiance *= horizon(lightTS, s);
	vec3 low, high;
	basis(lightTS, low, high);
	moments.low += outerProduct(irradiance, low);
	moments.high += outerProduct(irradiance, high);
}

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

// Moments of all lamps. s: height of the shell, 0 at the skin, 1 at the tips.
Moments lampMoments(mat3 frameVS, vec3 pointVS, float s) {
	Moments moments = Moments(mat3(0.0), mat3(0.0));
	IncidentLight light;
#if NUM_DIR_LIGHTS > 0
	for (int i = 0; i < NUM_DIR_LIGHTS; i++) {
		getDirectionalLightInfo(directionalLights[i], light);
		addLight(moments, frameVS, s, light.direction, light.color);
	}
#endif
#if NUM_POINT_LIGHTS > 0
	for (int i = 0; i < NUM_POINT_LIGHTS; i++) {
		getPointLightInfo(pointLights[i], pointVS, light);
		addLight(moments, frameVS, s, light.direction, light.color);
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	for (int i = 0; i < NUM_SPOT_LIGHTS; i++) {
		getSpotLightInfo(spotLights[i], pointVS, light);
		addLight(moments, frameVS, s, light.direction, light.color);
	}
#endif
	return moments;
}
