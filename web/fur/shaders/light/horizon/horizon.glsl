// Light at and below the horizon in format 1.x: clamped to the horizon, it fades out over the dip at the point's height.

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
#define ENVIRONMENT_LOW0 mat3x4(environmentLow0)
#define ENVIRONMENT_HIGH0 mat3x4(environmentHigh0)
#define ENVIRONMENT_LOW1 mat3x4(environmentLow1)
#define ENVIRONMENT_HIGH1 mat3x4(environmentHigh1)
#define ENVIRONMENT_LOW2 environmentLow2
#define ENVIRONMENT_HIGH2 environmentHigh2

#ifdef CURVES // curves 0..2 and 3..5 as polynomials: a column each, matrices for (u², v², uv), (u, v, 1), (w, uw, vw)
uniform mat3 polynomialLow[3];
#ifdef TWO_PLANES
uniform mat3 polynomialHigh[3];
#endif
#define POLYNOMIALS
#define POLYNOMIAL_LOW(part) polynomialLow[part]
#define POLYNOMIAL_HIGH(part) polynomialHigh[part]
#endif

float radiusTowards(FurPoint point, vec3 lightTS) {
	return bodyRadius;
}

float skyPlace(FurPoint point) {
	return 0.0;
}

// Dip of the horizon at a point: −sin of the lowest visible elevation.
float horizonDip(FurPoint point, float radius) {
	float cosine = radius / (radius + point.s);
	return max(sqrt(1.0 - cosine * cosine), 1e-4);
}

// Constant: texels hold all of the light.
vec4 curvesAt(float height, float left, float radius, vec3 lightTS) {
	return vec4(sqrt(left));
}

float meanLight(FurPoint point, vec4 curves) {
	return curves.x;
}
