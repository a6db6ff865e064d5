// Root of the hair displaced by morph targets.

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
