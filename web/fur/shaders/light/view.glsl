// Unit vector to the eye.
vec3 viewerVS(vec3 pointVS) {
	return isOrthographic ? vec3(0.0, 0.0, 1.0) : normalize(-pointVS);
}
