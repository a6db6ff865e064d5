// Light moments: m = Σ over lights of E·φ(l), and of the environment's radiance R, ∫R(ω)·φ(ω)dω over
// all directions that reach the fur.
// A texel's light is then one dot product with its coefficients, whatever the number of lights.
// Needs three's <common> and <lights_pars_begin>; directions are in view space until they enter the tangent frame (TS):
// (T, B, N) of a shell; of a fin (along the fur as it is laid, N, across it), its φ being of the first two as a shell's.

#ifdef FIN
#define UP y
#define UPRIGHT 1
#else
#define UP z
#define UPRIGHT 2 // index of the axis UP
#endif
#define LEVEL (3 - UPRIGHT) // index of the second level axis

// Moments of coefficients 0..2 and 3..5: a column per coefficient, a row per colour channel.
struct Moments {
	mat3 low;
	mat3 high;
};

const vec3 LUMINANCE = vec3(0.2126, 0.7152, 0.0722);

// Moments of light of one hue, which is a factor at the end.
struct Strengths {
	vec3 low;
	vec3 high;
};

// Light of the sky: its luminance differs from hair to hair, its hue from vertex to vertex.
struct SkyLight {
	Strengths moments;
	vec3 hue;
};

// Moments of lamps.
#ifdef ONE_HUE
#define Strength float
#define LampMoments Strengths
uniform vec3 lampHue; // hue of luminance 1
#else
#define Strength vec3
#define LampMoments Moments
#endif
#if defined(MULTIPLE) && defined(ONE_HUE)
#define TINGED // the lamps' light on the texel has a factor of colour
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

// Lit point of the fur.
struct FurPoint {
	mat3 frameVS; // (T, B, N) of the skin; for a fin (along the fur as it is laid, N, across it)
	vec3 comb; // displacement of the tip in that frame, share of the length
	vec3 pointVS;
	float reach; // length of the hair, world units
	float share; // length of the hair over that of the pelt's, at most 1
	float s; // 0 at the skin, 1 at the tip
	float slab; // slab shown; for a fin the place between slabs' middles
	vec3 curvature; // curvature of the skin, per length of the hair here: along the frame's first level axis, along the second, mixed
};

// Arrival of a lamp's light at a point of the body: the part that is equal at every height over the skin (format 2.x).
struct Arrival {
	vec3 lightTS; // unit vector to the lamp, clamped to the horizon
	float height; // lamp over the horizon, −1..1
	float radius; // β of the body towards it
	vec4 curves; // mean curves under it; format 1.x: X = share of the dip left
	vec3 nap; // its share for the eye before the bound MIN_SEEN, by 1, s, s²
	float surge; // factor of light beside the eye
#ifdef CURVES
	vec3 low; // φ of the light, unbent: costly here
	vec3 high;
#endif
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
