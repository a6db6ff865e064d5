// A lamp's light on fur that is bent further than it was baked. Texels are what they were; what changes is the direction
// from which light finds its way to them, and how much of it the hairs send on. The law is that of pelt/bent.py, and
// `furbake bend` holds it against bakes of the bent hairs.

uniform vec2 lean; // mean displacement of the tips inside the tile, share of the length along (T, B)
uniform vec4 bent[6]; // weights of eight terms, two vectors for each of 1, s, s²

#define BENT_MOST 0.6667 // displacement of the tip from which on the factor no longer changes

// The way that the fur leans, a unit vector in the axes of lightTS.
vec3 leanTS() {
	vec2 way = dot(lean, lean) > 1e-12 ? normalize(lean) : vec2(0.0, 1.0);
#ifdef FIN
	return vec3(way.y, 0.0, way.x);
#else
	return vec3(way, 0.0);
#endif
}

// comb: as of furPoint, in the axes of lightTS, which is not below the horizon and is turned to where it comes from in the
// baked fur. Returns what its strength is multiplied by.
float bentLight(inout vec3 lightTS, vec3 comb, float s) {
	float square = dot(comb, comb), rise = sqrt(max(1.0 - square, 0.04)), up = lightTS.UP;
	vec3 tip = comb * min(1.0, BENT_MOST * inversesqrt(max(square, 1e-8))), leaning = leanTS();
	float x = dot(tip, lightTS), q = dot(tip, tip), along = dot(leaning, lightTS);
	float gain = 1.0 + dot(bent[0] + s * (bent[2] + s * bent[4]), vec4(x * up, dot(tip, leaning), q * up, q));
	gain += dot(bent[1] + s * (bent[3] + s * bent[5]), vec4(x, q * along, q * along * up, x * along));
	// From s to the end, 1 unless they are cut, the hairs are sheared by (1 + s)·comb on the whole and as much lower: light as
	// long as its way through them runs through the same hairs as before.
	lightTS -= (furTrim + s) / rise * up * comb;
	lightTS.UP = up / rise;
	lightTS /= max(length(lightTS), 1e-4);
	return max(gain, 0.1);
}
