// Thin parts, such as whiskers, far away: a pixel wide at least, lest they fall into dots, and shorter by the share of a pixel
// that they are wide, down to nothing.
if (spine.w > 0.0) {
#ifdef USE_SKINNING
	mat4 placed = instanceMatrix * bindMatrixInverse * boneMatX * bindMatrix; // a thin part hangs on one joint
#else
	mat4 placed = instanceMatrix;
#endif
	vec4 seen = projectionMatrix * modelViewMatrix * placed * vec4(spine.xyz, 1.0);
	float pixel = 2.0 * seen.w / (projectionMatrix[1][1] * pictureHeight * length(placed[1].xyz));
	float kept = smoothstep(THIN_GONE, THIN_WHOLE, 2.0 * spine.w / pixel);
	vec3 aside = transformed - spine.xyz;
	float wide = length(aside);
	float least = min(0.5 * pixel, 4.0 * wide) * min(4.0 * kept, 1.0);
	transformed = mix(spineRoot, spine.xyz, kept) + aside * max(1.0, least / max(wide, 1e-9));
}
