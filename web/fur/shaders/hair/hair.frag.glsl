// Colour of the hairs: see hair.vert.glsl.

#ifdef COLOUR_PLANE
uniform sampler2DArray colourPlane; // colour of the texel's hairs (paper, eq. 4)
#endif

#ifdef ROOTS
uniform sampler2D roots; // colour of the skin below the tiles of the shells
uniform vec2 rootsUnit; // coordinates of that picture per tile
vec3 rootColour; // of this fragment
#define baseColour (vColour * rootColour)
#else
#define baseColour vColour
#endif

in vec3 vColour;
#ifdef COLOUR_PLANE
in float vTip2;
in float vHeight;
#endif

vec3 hairColour(vec3 at, float tint) {
#ifdef ROOTS
	// Hairs of a texel stand aside of it by the drift of its slab.
	rootColour = texture(roots, (at.xy - driftKnot(int(at.z + 0.5) - furRegion * LAYERS + 1)) * furWidth * rootsUnit).rgb;
#endif
#ifdef COLOUR_PLANE
	return soiled(baseColour * mix(furBytes(colourPlane, at).rgb, furRamp(1.0, vHeight) * tint, vTip2));
#else
	return soiled(baseColour * tint);
#endif
}
