// Texel of fur: its polynomial texture map, decoded (paper, eq. 3) and evaluated (eq. 1 without its factors 2).

uniform sampler2DArray plane0; // (a0, a1, a2, a5); with three coefficients (a0, a1, a2, α)
#ifdef CODINGS // furs have codings of their own
uniform vec4 codings[4 * FURS]; // scale0, offset0, scale1, offset1 below, fur after fur
#ifdef TWO_PLANES
uniform sampler2DArray plane1; // (a3, a4, α, tint)
#endif
#else
uniform vec4 scale0; // λ·255 per channel of plane0
uniform vec4 offset0; // −λ·Ω per channel of plane0
#ifdef TWO_PLANES
uniform sampler2DArray plane1; // (a3, a4, α, tint)
uniform vec2 scale1; // λ·255 of a3, a4
uniform vec2 offset1; // −λ·Ω of a3, a4
#endif
#endif
uniform float gloss; // strength of both highlights
uniform float backlight; // strength of light through the hairs from behind

#define FAINT 2e-3 // light of lamps, 4π·radiance of white, below which shadows are skipped
#define CREST 2.2 // L with full shine on wet fur

struct FurTexel {
	float alpha; // coverage of a slab of the baked thickness, seen from straight above
	float tint;
	vec3 low; // a0, a1, a2
	vec3 high; // a3, a4, a5
};

FurTexel furTexel(vec3 at) {
	FurTexel texel;
#ifdef CODINGS
	vec4 scale0 = ofFur(codings, 4, 0), offset0 = ofFur(codings, 4, 1), scale1 = ofFur(codings, 4, 2), offset1 = ofFur(codings, 4, 3);
#endif
	vec4 byte0 = furBytes(plane0, at);
	vec4 a = byte0 * scale0 + offset0;
	texel.low = a.xyz;
#ifdef TWO_PLANES
	vec4 byte1 = furBytes(plane1, at);
	texel.high = vec3(byte1.xy * scale1.xy + offset1.xy, a.w);
	texel.alpha = denser(byte1.z);
	texel.tint = byte1.w;
#else
	texel.alpha = denser(byte0.w);
	texel.tint = 1.0;
#endif
#ifdef MUD
	// Hairs without mud keep their own light.
	vec4 dirty0 = dirtyBytes(plane0, at), dirty1 = dirtyBytes(plane1, at);
	vec4 dirtyA = dirty0 * scale0 + offset0;
	float lit = vDirt * mix(1.0, dirty1.w, furWetness);
	texel.low = mix(texel.low, dirtyA.xyz, lit);
	texel.high = mix(texel.high, vec3(dirty1.xy * scale1.xy + offset1.xy, dirtyA.w), lit);
	texel.alpha = muddy(texel.alpha, dirty1.w, denser(dirty1.z));
#elif defined(DIRTY)
	mudShare = MUD_SHARE * vDirt;
#endif
	return texel;
}

// Σ over lights of E·L, L in the unit 4π·radiance / (albedo·irradiance); never negative.
float relight(FurTexel texel, Strengths moments) {
	float light = dot(moments.low, texel.low);
#ifdef TWO_PLANES
	light += dot(moments.high, texel.high);
#endif
	return max(light, 0.0);
}

#ifdef ONE_HUE
vec3 hued(float strength) {
	return strength * lampHue;
}
#else
vec3 relight(FurTexel texel, Moments moments) {
	vec3 light = moments.low * texel.low;
#ifdef TWO_PLANES
	light += moments.high * texel.high;
#endif
	return max(light, 0.0);
}

vec3 hued(vec3 light) {
	return light;
}
#endif

#ifdef GLOSS
// Strength of the white highlight on hairs of this colour, 0..1. The texel's light is that among the hairs of the bake; dark
// and deep hairs scatter less of it, and a highlight as strong as on pale ones would cover their colour.
float whiteShine(vec3 colour) {
	return min(0.15 + dot(colour, LUMINANCE) + min(min(colour.r, colour.g), colour.b), 1.0);
}
#endif

// 4π·radiance of a texel whose hairs have this colour. Lamps and environment are clamped apart: a polynomial
// that dips below zero under a strong lamp must not reduce the light of the sky, which turns shadows blue.
vec3 furRadiance(FurTexel texel, vec3 colour, Lamps lamps, SkyLight sky) {
	vec3 lamp = hued(relight(texel, lamps.moments));
#ifdef TINGED
	lamp *= lamps.tinge.rgb;
#endif
#ifdef SHADOW_PER_FRAGMENT
	vec3 most = lamp;
#ifdef BACKLIGHT
	most += hued(lamps.back) * backlight;
#endif
	if (max(max(most.r, most.g), most.b) > FAINT) {
		float open = firstShadow(lamps.place);
#ifdef SHADOW_SHARE
		open = 1.0 - lamps.share * (1.0 - open);
#endif
		lamp *= open;
		lamps.back *= open;
#ifdef WET
		lamps.power *= open;
#endif
	}
#endif
	vec3 light = lamp;
#ifdef SKY
	light += relight(texel, sky.moments) * sky.hue;
#endif
#ifdef BACKLIGHT
	light += hued(lamps.back) * (backlight * texel.alpha);
#endif
#ifdef GLOSS
	// The lamps' light on the texel shadows the highlights.
	vec2 shine = gloss * vec2(texel.tint, 1.0) * lamps.lobes;
#ifdef WET
	// Water shines on hairs of any colour.
	shine.x *= mix(whiteShine(colour), 1.0, furWetness);
	// A film of water shines on the clumps' crests, where the lamps' light is strongest.
	float lit = min(dot(lamp, LUMINANCE) / max(CREST * lamps.power, 1e-6), 1.0);
	shine *= mix(1.0, lit * lit * lit, furWetness);
#else
	shine.x *= whiteShine(colour);
#endif
#ifdef DIRTY
	shine.x *= 1.0 - mudShare;
#endif
	return colour * (light + lamp * shine.y) + lamp * shine.x;
#else
	return colour * light;
#endif
}
