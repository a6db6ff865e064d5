// Placement of a vertex's body.

#ifdef BODIES
in mat4 body; // per instance: the mesh's axes → the axes of all bodies together
#endif

mat4 bodyModel() {
#ifdef BODIES
	return modelMatrix * body;
#else
	return modelMatrix;
#endif
}

mat4 bodyModelView() {
#ifdef BODIES
	return modelViewMatrix * body;
#else
	return modelViewMatrix;
#endif
}
