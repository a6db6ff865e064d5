uniform float finOpacity;
#ifdef COLOUR_PLANE
uniform sampler2DArray colourPlane; // colour of the texel's hairs
#endif

#ifdef ROOTS
uniform sampler2D roots; // colour of the skin at the roots of the hairs
in vec2 vRoot;
vec3 rootColour; // colour at the roots of this fragment's hairs
#define baseColour (vSkin.rgb * rootColour)
#else
#define baseColour vSkin.rgb
#endif

centroid in vec4 vSkin;
out vec4 fragColour;

void main() {
	vec3 at = vec3(vAt, float(furHairs));
	FurTexel texel = furTexel(at);
#ifdef ROOTS
	rootColour = texture(roots, vRoot).rgb;
#endif
	float alpha = texel.alpha * (vFade - 2.0 * float(furRegion)) * finOpacity;
	if (alpha < 0.01) discard;
	vec3 colour = furRamp(vSkin.a, clamp(vAt.y, 0.0, 1.0)) * texel.tint;
#ifdef COLOUR_PLANE
	colour = mix(furBytes(colourPlane, at).rgb, colour, vSkin.a);
#endif
	fragColour = furOutput(furRadiance(texel, soiled(baseColour * colour), receivedLamps(), receivedSky()), alpha);
}
