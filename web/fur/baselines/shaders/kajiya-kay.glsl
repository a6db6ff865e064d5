// Light of one lamp on a thin cylinder. J. T. Kajiya, T. L. Kay: Rendering Fur with Three Dimensional Textures, SIGGRAPH
// 1989. All vectors have unit length and point away from the hair.

// sin of the angle between hair and lamp.
float kajiyaKayDiffuse(vec3 strand, vec3 light) {
	float along = dot(strand, light);
	return sqrt(max(1.0 - along * along, 0.0));
}

// cos of the viewer's angle to the cone of mirrored light, to the power of `sharpness`.
float kajiyaKaySpecular(vec3 strand, vec3 light, vec3 viewer, float sharpness) {
	vec2 along = vec2(dot(strand, light), dot(strand, viewer));
	vec2 across = sqrt(max(1.0 - along * along, 0.0));
	return pow(max(across.x * across.y - along.x * along.y, 0.0), sharpness);
}
