// Takes the pose: see root.glsl.

// Finds the root; call it before all other functions of the hairs.
void takePose() {
	takeFur();
#ifdef POSED
	rootPosition = position;
	rootNormal = normalize(normal);
	rootTangent = tangent.xyz;
#ifdef MORPHS
	morphRoot();
#endif
	restNormal = rootNormal;
	restTangent = rootTangent;
#ifdef USE_SKINNING
	skinRoot();
#endif
#endif
}

// Turns a displacement of the tip with its root. It depends on no tangent: overlapping patches, each with tangents of its own,
// need equal hairs to the bit.
vec3 posedDisplacement(vec3 v) {
#ifdef POSED
	vec3 n = normalize(normal);
	float outwards = dot(v, n);
	vec3 level = v - outwards * n, turned = level;
#ifdef USE_SKINNING
	turned = rootTurn * turned;
#endif
	turned -= rootNormal * dot(rootNormal, turned);
	float square = dot(turned, turned);
	return outwards * rootNormal + (square > 0.0 ? sqrt(dot(level, level) / square) * turned : level);
#else
	return v;
#endif
}
