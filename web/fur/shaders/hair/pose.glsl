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

#ifdef MORPHS // most targets at a time
uniform highp isampler2DArray morphDeltas; // layer per target; three texels per vertex: changes of position, normal, tangent
uniform float morphUnit; // change of the position stored as 1, the mesh's own units
uniform int morphCount; // targets in use
uniform vec4 morphs[(MORPHS + 1) / 2]; // two each: target, weight
#define MORPH_ROW 512 // vertices in a row of texels
#define MORPH_TURN (2.0 / 32767.0) // change of a unit vector stored as 1

void morphRoot() {
	mat3 sums = mat3(0.0);
	ivec2 at = ivec2(3 * (gl_VertexID % MORPH_ROW), gl_VertexID / MORPH_ROW);
	for (int i = 0; i < morphCount; i++) {
		vec4 two = morphs[i >> 1];
		vec2 target = (i & 1) == 0 ? two.xy : two.zw;
		for (int part = 0; part < 3; part++)
			sums[part] += target.y * vec3(texelFetch(morphDeltas, ivec3(at.x + part, at.y, int(target.x)), 0).xyz);
	}
	rootPosition += morphUnit * sums[0];
	rootNormal = normalize(rootNormal + MORPH_TURN * sums[1]);
	rootTangent += MORPH_TURN * sums[2];
}
#endif

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
