out vec3 vColour; // of the hairs but for the texel's tint, linear; with a colour plane what multiplies it
#ifdef COLOUR_PLANE
out float vTip2; // from the texel's original colour to tip2
out float vHeight; // 0 at the skin, 1 at the tip
#endif

void main() {
	ShellPoint shell = shellPoint();
	vec3 tip = position + shell.normal * (furLength * _fur.y);
	if (shell.there)
		passLight(FurPoint(shell.frameVS, shell.pointVS, (bodyModel() * vec4(tip, 1.0)).xyz, shell.s), _fur.z);
	else passDarkness();

	vColour = skinColour * color.rgb;
#ifdef COLOUR_PLANE
	vTip2 = _fur.w;
	vHeight = shell.s;
#else
	vColour *= furRamp(_fur.w, shell.s);
#endif
}
