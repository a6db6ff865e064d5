// Vertex of the skin below shells.

// Defaults of absent attributes are kept by location for all programs, so each attribute has its own location.
layout(location = 13) in vec4 _fur; // X = lapped weight, Y = share of the longest fur, Z = openness to the sky, W = mix of tip and tip2, all 0..1
layout(location = 14) in vec3 _comb; // displacement of the tip in the tangent plane, share of the length, the mesh's own axes

// (T, B, N) in the pose, the mesh's own axes.
mat3 skinFrame() {
	vec3 n = normalize(rootNormal);
	vec3 t = normalize(rootTangent - n * dot(n, rootTangent));
	return mat3(t, tangent.w * cross(n, t), n);
}
