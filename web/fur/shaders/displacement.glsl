// Shell s of the fur above a point of the skin, in the mesh's own units (Lengyel 2001: shells are the skin moved outwards).

uniform float furLength; // longest fur, the mesh's own units

vec3 furPoint(vec3 root, vec3 outward, float lengthShare, float s) {
	return root + outward * (furLength * lengthShare * s);
}
