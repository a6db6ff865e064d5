#ifdef COLOUR_PLANE
uniform sampler2DArray colourPlane; // the texel's original colour (paper, eq. 4)
#endif

in vec3 vAt;
in vec3 vColour;
#ifdef COLOUR_PLANE
in float vTip2;
in float vHeight;
#endif

out vec4 fragColour;

void main() {
	FurTexel texel = furTexel(vAt);
#ifdef COLOUR_PLANE
	vec3 colour = vColour * mix(texture(colourPlane, vAt).rgb, furRamp(1.0, vHeight) * texel.tint, vTip2);
#else
	vec3 colour = vColour * texel.tint;
#endif
	if (texel.alpha < alphaCut) discard;
	fragColour = furOutput(furRadiance(texel, colour, receivedLamps(), receivedSky()), shellOpacity(texel.alpha));
}
