// A texel of fur: its polynomial texture map, decoded (paper, eq. 3) and evaluated (eq. 1 without its factors 2).

uniform sampler2DArray plane0; // (a0, a1, a2, a5); with three coefficients (a0, a1, a2, α)
uniform vec4 scale0; // λ·255 per channel of plane0
uniform vec4 offset0; // −λ·Ω per channel of plane0
#ifdef TWO_PLANES
uniform sampler2DArray plane1; // (a3, a4, α, tint)
uniform vec2 scale1; // λ·255 of a3, a4
uniform vec2 offset1; // −λ·Ω of a3, a4
#endif

#ifndef LOD_BIAS
#define LOD_BIAS 0.0
#endif

struct FurTexel {
	float alpha; // coverage of a slab of the baked thickness, seen from straight above
	float tint;
	vec3 light; // Σ over lights of E·L, L in the unit 4π·radiance / (albedo·irradiance)
};

// Light moments of coefficients 0..2 (low) and 3..5 (high), a column each. Lamps and environment are clamped apart: where
// a polynomial dips below zero under a strong lamp it must not eat the light of the sky, which turns shadows blue.
FurTexel furTexel(vec3 at, mat3 lampLow, mat3 lampHigh, mat3 skyLow, mat3 skyHigh) {
	FurTexel texel;
	vec4 byte0 = texture(plane0, at, LOD_BIAS);
	vec4 a = byte0 * scale0 + offset0;
	vec3 lamps = lampLow * a.xyz, sky = skyLow * a.xyz;
#ifdef TWO_PLANES
	vec4 byte1 = texture(plane1, at, LOD_BIAS);
	vec3 b = vec3(byte1.xy * scale1 + offset1, a.w);
	lamps += lampHigh * b;
	sky += skyHigh * b;
	texel.alpha = byte1.z;
	texel.tint = byte1.w;
#else
	texel.alpha = byte0.w;
	texel.tint = 1.0;
#endif
	texel.light = max(lamps, 0.0) + max(sky, 0.0);
	return texel;
}
