// Light on fur that is bent further than it was baked. Texels are what they were; what changes is the direction from which
// light finds its way to them, and how much of it the hairs send on. The law is that of pelt/bent.py, and `furbake bend`
// holds it against bakes of the bent hairs.

uniform vec2 lean; // mean displacement of the tips inside the tile, share of the length along (T, B)
uniform vec4 bent[6]; // weights of eight terms, two vectors for each of 1, s, s²

#define BENT_MOST 0.6667 // displacement of the tip from which on the factor no longer changes

// The law at a point, in the axes of lightTS.
struct Bending {
	bool there; // whether the fur is bent at all
	vec3 shear; // what light from straight above is turned by
	float rise; // share of its height that the fur still has
	Quadratic factor;
};

// The way that the fur leans, a unit vector in the axes of lightTS.
vec3 leanTS() {
	vec2 way = dot(lean, lean) > 1e-12 ? normalize(lean) : vec2(0.0, 1.0);
#ifdef FIN
	return vec3(way.y, 0.0, way.x);
#else
	return vec3(way, 0.0);
#endif
}

// comb: as of furPoint, in the axes of lightTS.
Bending bendingOf(vec3 comb, float s) {
	Bending bending;
	float square = dot(comb, comb);
	bending.there = square > 0.0;
	bending.shear = vec3(0.0);
	bending.factor = Quadratic(1.0, vec3(0.0), mat3(0.0));
	bending.rise = sqrt(max(1.0 - square, 0.04));
	if (!bending.there) return bending;
	// From s to the end, 1 unless they are cut, the hairs are sheared by (1 + s)·comb on the whole and as much lower: light as
	// long as its way through them runs through the same hairs as before.
	bending.shear = (furTrim + s) / bending.rise * comb;
	vec3 tip = comb * min(1.0, BENT_MOST * inversesqrt(max(square, 1e-8))), leaning = leanTS(), upright = vec3(0.0);
	upright.UP = 1.0;
	float q = dot(tip, tip);
	// In the order of the format, with y = leaning·l: x·z, p, q·z, q; x, q·y, q·y·z, x·y.
	vec4 first = bent[0] + s * (bent[2] + s * bent[4]), second = bent[1] + s * (bent[3] + s * bent[5]);
	bending.factor.even = 1.0 + first.y * dot(tip, leaning) + first.w * q;
	bending.factor.gradient = second.x * tip + q * (first.z * upright + second.y * leaning);
	bending.factor.form = outerProduct(first.x * tip + second.z * q * leaning, upright) + second.w * outerProduct(tip, leaning);
	return bending;
}

// lightTS: not below the horizon; is turned to where it comes from in the baked fur. Returns what its strength is multiplied
// by.
float bentLight(inout vec3 lightTS, Bending bending) {
	float gain = quadratic(bending.factor, lightTS), up = lightTS.UP;
	lightTS -= up * bending.shear;
	lightTS.UP = up / bending.rise;
	lightTS /= max(length(lightTS), 1e-4);
	return max(gain, 0.1);
}
