// Colour of the hairs: see hair.vert.glsl.

#ifdef COLOUR_PLANE
uniform sampler2DArray colourPlane; // colour of the texel's hairs (paper, eq. 4)
#endif

#ifdef ROOTS
uniform sampler2D roots; // colour of the skin below the tiles of the shells
uniform vec2 rootsUnit; // coordinates of that picture per tile
vec3 rootColour; // colour at the roots of this fragment's hairs
#define baseColour (vColour * rootColour)
#else
#define baseColour vColour
#endif

centroid in vec3 vColour;
#ifdef COLOUR_PLANE
centroid in float vTip2;
centroid in Ramp vRamp;
#endif

vec3 hairColour(vec3 at, float tint) {
#ifdef ROOTS
	// Hairs of a texel stand aside of it by the drift of its slab.
	rootColour = texture(roots, rootTiles(at) * furWidth * rootsUnit).rgb;
#endif
#ifdef COLOUR_PLANE
	return soiled(baseColour * mix(furBytes(colourPlane, at).rgb, rampAt(1.0, vRamp) * tint, vTip2));
#else
	return soiled(baseColour * tint);
#endif
}
