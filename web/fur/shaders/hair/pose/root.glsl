// Root of the hair at a vertex, in its body's pose: displaced by morph targets, then moved by joints. And the placement of
// that body.

in vec4 tangent; // unit vector along the surface; W = hand of the frame

#ifdef BODIES
// Per instance: the mesh's axes → the axes of all bodies together. Where joints move it, its fourth row, 0 otherwise, begins
// with the first joint of the body's own pose.
in mat4 body;

mat4 bodyPlacement() {
	mat4 placement = body;
	placement[0][3] = 0.0;
	return placement;
}
#endif

mat4 bodyModel() {
#ifdef BODIES
	return modelMatrix * bodyPlacement();
#else
	return modelMatrix;
#endif
}

mat4 bodyModelView() {
#ifdef BODIES
	return modelViewMatrix * bodyPlacement();
#else
	return modelViewMatrix;
#endif
}

#if defined(USE_SKINNING) || defined(MORPHS)
#define POSED
vec3 rootPosition;
vec3 rootNormal;
vec3 rootTangent;
// Normal and tangent before the joints.
vec3 restNormal;
vec3 restTangent;
#else
#define rootPosition position
#define rootNormal normal
#define rootTangent tangent.xyz
#endif
