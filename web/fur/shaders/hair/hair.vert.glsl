// Part of the hairs' colour that is independent of the texel, for any light.

centroid out vec3 vColour; // linear; a factor where there is a colour plane, or a picture of the roots
#ifdef COLOUR_PLANE
centroid out float vTip2; // mix of the texel's colour and tip2
#ifdef VERTEX_TIPS
centroid out vec3 vTips; // tip2 at this height
#define secondTips vTips
#else
centroid out float vRamp; // place on the ramp
#define secondTips rampAt(1.0, vRamp)
#endif
#endif

#ifdef ROOTS
#define baseColour (vColour * color.rgb)
#else
#define baseColour vColour
#endif

void passColour(ShellPoint shell) {
#ifdef ROOTS
	vColour = skinColor;
#else
	vColour = skinColor * color.rgb;
#endif
#ifdef WET
	vColour *= furTraits.y;
#endif
#ifdef COLOUR_PLANE
	vTip2 = tipShare * _fur.w;
	float place = rampPlace(shell.s);
#ifdef VERTEX_TIPS
	vTips = rampAt(1.0, place);
#else
	vRamp = place;
#endif
#else
	vColour *= furRamp(tipShare * _fur.w, shell.s);
#endif
}
