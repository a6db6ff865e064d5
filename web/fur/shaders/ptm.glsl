// A texel of fur: its polynomial texture map, decoded (paper, eq. 3) and evaluated (eq. 1 without its factors 2).

uniform sampler2DArray plane0; // (a0, a1, a2, a5); with three coefficients (a0, a1, a2, α)
uniform vec4 scale0; // λ·255 per channel of plane0
uniform vec4 offset0; // −λ·Ω per channel of plane0
#ifdef TWO_PLANES
uniform sampler2DArray plane1; // (a3, a4, α, tint)
uniform vec2 scale1; // λ·255 of a3, a4
uniform vec2 offset1; // −λ·Ω of a3, a4
#endif

struct FurTexel {
	float alpha; // coverage of a slab of the baked thickness, seen from straight above
	float tint;
	vec3 light; // Σ over lights of E·L, L in the unit 4π·radiance / (albedo·irradiance)
};

// low, high: light moments of coefficients 0..2 and 3..5, a column each.
FurTexel furTexel(vec3 at, mat3 low, mat3 high) {
	FurTexel texel;
	vec4 byte0 = texture(plane0, at);
	vec4 a = byte0 * scale0 + offset0;
	texel.light = low * a.xyz;
#ifdef TWO_PLANES
	vec4 byte1 = texture(plane1, at);
	texel.light += high * vec3(byte1.xy * scale1 + offset1, a.w);
	texel.alpha = byte1.z;
	texel.tint = byte1.w;
#else
	texel.alpha = byte0.w;
	texel.tint = 1.0;
#endif
	texel.light = max(texel.light, 0.0);
	return texel;
}
