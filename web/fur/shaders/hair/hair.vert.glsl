// Part of the hairs' colour that is independent of the texel, for any light.

centroid out vec3 vColour; // linear; a factor where there is a colour plane, or a picture of the roots
#ifdef COLOUR_PLANE
centroid out float vTip2; // mix of the texel's colour and tip2
centroid out Ramp vRamp;
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
	vRamp = rampOf(rampPlace(shell.s));
#else
	vColour *= furRamp(tipShare * _fur.w, shell.s);
#endif
}
