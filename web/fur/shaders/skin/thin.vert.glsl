// Thin parts, such as whiskers, far away: a pixel wide at least, lest they fall into dots, and shorter by the share of a pixel
// that they are wide, down to nothing.
if (spine.w > 0.0) {
	mat4 toView = modelViewMatrix;
#ifdef USE_INSTANCING
	toView *= instanceMatrix;
#endif
#ifdef USE_SKINNING
	toView *= bindMatrixInverse * boneMatX * bindMatrix; // a thin part hangs on one joint
#endif
	vec3 aside = transformed - spine.xyz;
	float wide = length(aside);
	vec3 way = spine.xyz - spineRoot;
	// A tip's only vertex has no side of its own.
	vec3 across = wide > 0.01 * spine.w ? aside : cross(way, abs(way.x) < abs(way.y) ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
	float scale = length(mat3(toView) * across) / max(length(across), 1e-9);
	float pixel = 2.0 * (projectionMatrix * toView * vec4(spine.xyz, 1.0)).w / (projectionMatrix[1][1] * pictureHeight * scale);
	float kept = smoothstep(THIN_GONE, THIN_WHOLE, 2.0 * spine.w / pixel);
	float least = min(THIN_LEAST * pixel, 4.0 * wide) * min(4.0 * kept, 1.0);
	transformed = mix(spineRoot, spine.xyz, kept) + aside * max(1.0, least / max(wide, 1e-9));
}
