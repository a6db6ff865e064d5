// The hairs' colour but for what the texel says of it, whatever the shell is lit by.

out vec3 vColour; // linear; with a colour plane what multiplies it
#ifdef COLOUR_PLANE
out float vTip2; // from the texel's original colour to tip2
out float vHeight; // 0 at the skin, 1 at the tip
#endif

void passColour(ShellPoint shell) {
	vColour = skinColour * color.rgb;
#ifdef WET
	vColour *= furTraits.y;
#endif
#ifdef COLOUR_PLANE
	vTip2 = tipShare * _fur.w;
	vHeight = shell.s;
#else
	vColour *= furRamp(tipShare * _fur.w, shell.s);
#endif
}
