// Root of the hair moved by joints.

#ifdef USE_SKINNING
uniform mat4 bindMatrix;
uniform mat4 bindMatrixInverse;
uniform highp sampler2D boneTexture; // four texels per joint: columns of its matrix
mat3 rootTurn; // rest axes → pose, of joints alone
float rootScale; // size in the pose over that at rest

mat4 jointMatrix(float joint) {
#ifdef BODIES
	joint += body[0][3];
#endif
	int size = textureSize(boneTexture, 0).x, first = 4 * int(joint);
	ivec2 at = ivec2(first % size, first / size);
	return mat4(
		texelFetch(boneTexture, at, 0),
		texelFetch(boneTexture, at + ivec2(1, 0), 0),
		texelFetch(boneTexture, at + ivec2(2, 0), 0),
		texelFetch(boneTexture, at + ivec2(3, 0), 0)
	);
}

// Unit normal of a surface in the pose: across what lay across it, whatever the joints stretch.
vec3 posedNormal(vec3 n) {
	mat3 m = rootTurn;
	vec3 across = cross(m[1], m[2]);
	vec3 turned = n.x * across + n.y * cross(m[2], m[0]) + n.z * cross(m[0], m[1]);
	float square = dot(turned, turned);
	// A part that joints shrink to nothing keeps any direction.
	return square > 1e-20 ? turned * (inversesqrt(square) * (dot(m[0], across) < 0.0 ? -1.0 : 1.0)) : n;
}

void addJoint(float joint, float weight, inout mat4 sum) {
	if (weight == 0.0) return;
	mat4 matrix = jointMatrix(joint);
	sum += weight * matrix;
	rootScale += weight * length(matrix[0].xyz);
}

void skinRoot() {
	mat4 sum = mat4(0.0);
	rootScale = 0.0;
	addJoint(skinIndex.x, skinWeight.x, sum);
	addJoint(skinIndex.y, skinWeight.y, sum);
	addJoint(skinIndex.z, skinWeight.z, sum);
	addJoint(skinIndex.w, skinWeight.w, sum);
	rootTurn = mat3(bindMatrixInverse) * mat3(sum) * mat3(bindMatrix);
	rootScale *= length(bindMatrixInverse[0].xyz) * length(bindMatrix[0].xyz);
	rootPosition = (bindMatrixInverse * (sum * (bindMatrix * vec4(rootPosition, 1.0)))).xyz;
	rootNormal = posedNormal(rootNormal);
	rootTangent = rootTurn * rootTangent;
}
#endif
