// A lamp's light on fur that is bent further than it was baked. Texels are what they were; what changes is the direction
// from which light finds its way to them, and how much of it the hairs send on. `furbake bend` holds it against bakes of the
// bent hairs (1.21 times the error of the unbent fit; 1.51 without this, 1.98 with a frame that turns with the hairs) and says
// where each term comes from.

uniform vec2 lean; // mean displacement of the tips inside the tile, share of the length along (T, B)

// The same in the axes of lightTS.
#ifdef FIN
#define LEAN vec3(lean.y, 0.0, lean.x)
#else
#define LEAN vec3(lean, 0.0)
#endif

// comb: as of furPoint, in the axes of lightTS, which is not below the horizon and is turned to where it comes from in the
// baked fur. Returns what its strength is multiplied by.
float bentLight(inout vec3 lightTS, vec3 comb, float s) {
	float square = dot(comb, comb), rise = sqrt(max(1.0 - square, 0.04)), up = lightTS.UP, along = dot(comb, lightTS);
	// From s to the end, 1 unless they are cut, the hairs are sheared by (1 + s)·comb on the whole and as much lower: light as
	// long as its way through them runs through the same hairs as before.
	lightTS -= (furTrim + s) / rise * up * comb;
	lightTS.UP = up / rise;
	lightTS /= max(length(lightTS), 1e-4);
	return max(1.0 - 0.5 * dot(comb, LEAN) + s * (square * (2.7 * up - 1.5) - 1.8 * along * up), 0.1);
}
