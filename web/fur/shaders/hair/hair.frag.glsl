// Colour of the hairs: see hair.vert.glsl.

#ifdef COLOUR_PLANE
uniform sampler2DArray colourPlane; // colour of the texel's hairs (paper, eq. 4)
#endif

in vec3 vColour;
#ifdef COLOUR_PLANE
in float vTip2;
in float vHeight;
#endif

vec3 hairColour(vec3 at, float tint) {
#ifdef COLOUR_PLANE
	return soiled(vColour * mix(furBytes(colourPlane, at).rgb, furRamp(1.0, vHeight) * tint, vTip2));
#else
	return soiled(vColour * tint);
#endif
}
