// Light moments: m = Σ over lights of E·φ(l), and of the environment's radiance R, ∫R(ω)·φ(ω)dω over
// all directions that reach the fur.
// A texel's light is then one dot product with its coefficients, whatever the number of lights.
// Needs three's <common> and <lights_pars_begin>; directions are in view space until they enter the tangent frame (TS):
// (T, B, N) of a shell; of a fin (along the edge, N, across it), its φ being of the first two as a shell's.

#ifdef FIN
#define UP y
#define UPRIGHT 1
#else
#define UP z
#define UPRIGHT 2 // the axis of UP
#endif
#define LEVEL (3 - UPRIGHT) // the level axis beside the first

// Moments of coefficients 0..2 and 3..5: a column per coefficient, a row per colour channel.
struct Moments {
	mat3 low;
	mat3 high;
};

// Those of lamps. Where all of them have one hue they are moments of their strengths, which it multiplies in the end.
#ifdef ONE_HUE
#define Strength float
struct LampMoments {
	vec3 low;
	vec3 high;
};
uniform vec3 lampHue; // of luminance 1
#else
#define Strength vec3
#define LampMoments Moments
#endif
#if defined(MULTIPLE) && defined(ONE_HUE)
#define TINGED // a colour multiplies the lamps' light on the texel
#endif

// R = constant + gradient·ω + ωᵀ·form·ω in the tangent frame.
struct Radiance {
	vec3 constant;
	mat3 gradient; // a column per axis
	mat3 form[3]; // traceless, one for each channel
};

// even + gradient·l + l·form·l
struct Quadratic {
	float even;
	vec3 gradient;
	mat3 form;
};

float quadratic(Quadratic of, vec3 at) {
	return of.even + dot(at, of.gradient + of.form * at);
}

// A point of the fur that is lit.
struct FurPoint {
	mat3 frameVS; // (T, B, N) of the skin; of a fin (along the edge, N, across it)
	vec3 comb; // displacement of the tip in that frame, share of the length
	vec3 pointVS;
	float reach; // of the hair, world units
	float s; // 0 at the skin, 1 at the tip
	float slab; // that is shown; of a fin the place between slabs' middles
	vec3 curvature; // of the skin, per length of the hair here: along the frame's first axis, along the other level one, mixed
};

uniform float bodyRadius; // β, in lengths of the fur, of the body as a whole; format 1.x

// φ(l) of a light above the horizon. Paper, eq. (2), or smooth light curves: sums of functions of u, v, w, √w and ∜w.
void basis(vec3 lightTS, out vec3 low, out vec3 high) {
	float u = lightTS.x, v = lightTS.y;
#ifdef CURVES
	float w = lightTS.z, root = sqrt(w), root4 = sqrt(root);
	low = CURVES_LOW;
#ifdef TWO_PLANES
	high = CURVES_HIGH;
#else
	high = vec3(0.0);
#endif
#else
	low = vec3(u * u, v * v, u * v);
	high = vec3(u, v, 1.0);
#endif
}
