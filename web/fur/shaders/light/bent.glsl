// Light on fur that is bent further than baked. Texels stay; the effective direction of light and the hairs' reflectance
// change, by the law of pelt/bent.py. `furbake bend` compares it with bakes of the bent hairs.

#if FURS > 1
uniform vec2 leans[FURS]; // lean of each fur
#define lean ofFur(leans, 1, 0)
#else
uniform vec2 lean; // mean displacement of the tips inside the tile, share of the length along (T, B)
#endif
uniform vec4 bent[6 * FURS]; // weights of eight terms, fur after fur, two vectors for each of 1, s, s²

#if defined(STRAIGHT) && !defined(SWING)
#if STRAIGHT
#define UNBENT // no hair is bent further than baked
#endif
#endif

#define MAX_BEND 0.6667 // displacement of the tip beyond which the factor is constant

// Terms of the law at a point, in the axes of lightTS.
struct Bending {
	bool there; // whether the fur is bent at all
	vec3 shear; // shear of light from straight above
	float rise; // share of the fur's height that is left
	Quadratic factor;
};

// Unit vector along the fur's lean, in the axes of lightTS.
vec3 leanTS() {
	vec2 way = dot(lean, lean) > 1e-12 ? normalize(lean) : vec2(0.0, 1.0);
#ifdef FIN
	return vec3(way.y, 0.0, way.x);
#else
	return vec3(way, 0.0);
#endif
}

// comb: FurPoint.comb in the axes of lightTS.
Bending bendingOf(vec3 comb, float s) {
	Bending bending;
	float square = dot(comb, comb);
#ifdef UNBENT
	bending.there = false;
#else
	bending.there = square > 0.0;
#endif
	bending.shear = vec3(0.0);
	bending.factor = Quadratic(1.0, vec3(0.0), mat3(0.0));
	bending.rise = sqrt(max(1.0 - square, 0.04));
	if (!bending.there) return bending;
	// From s to the end (1 unless cut) hairs are sheared by (1 + s)·comb on the whole, and lower: light with a path of equal
	// length runs through the same hairs as before.
	bending.shear = (furTrim + s) / bending.rise * comb;
	vec3 tip = comb * min(1.0, MAX_BEND * inversesqrt(max(square, 1e-8))), leaning = leanTS(), upright = vec3(0.0);
	upright.UP = 1.0;
	float q = dot(tip, tip);
	// In the order of the format, with y = leaning·l: x·z, p, q·z, q; x, q·y, q·y·z, x·y.
	vec4 first = ofFur(bent, 6, 0) + s * (ofFur(bent, 6, 2) + s * ofFur(bent, 6, 4));
	vec4 second = ofFur(bent, 6, 1) + s * (ofFur(bent, 6, 3) + s * ofFur(bent, 6, 5));
	bending.factor.even = 1.0 + first.y * dot(tip, leaning) + first.w * q;
	bending.factor.gradient = second.x * tip + q * (first.z * upright + second.y * leaning);
	bending.factor.form = outerProduct(first.x * tip + second.z * q * leaning, upright) + second.w * outerProduct(tip, leaning);
	return bending;
}

// Direction above the horizon whose path through the baked hairs equals this one's through bent hairs.
vec3 unbent(vec3 ts, Bending bending) {
	float up = ts.UP;
	ts -= up * bending.shear;
	ts.UP = up / bending.rise;
	return ts / max(length(ts), 1e-4);
}

// Factor of a lamp's strength. lightTS: not below the horizon; turned to its equivalent direction in the baked fur.
float bentLight(inout vec3 lightTS, Bending bending) {
	float gain = quadratic(bending.factor, lightTS);
	lightTS = unbent(lightTS, bending);
	return max(gain, 0.1);
}
