// A vertex of a shell: where it stands, which texels it shows, and how much fur it stands for.

in vec4 tangent;
in vec4 color; // of the skin, linear
in vec4 _fur; // X = lapped weight, Y = share of the longest fur, Z = openness to the sky, W = from tip to tip2, all 0..1
in vec3 _comb; // displacement of the tip in the tangent plane, share of the length, the mesh's own axes
in vec4 shell; // per instance: X = s of the shell, Y = slab it shows, ZW = shear of the look-up, tile widths
#ifdef BODIES
in mat4 body; // per instance: the mesh's axes → the axes of all bodies together
#endif

uniform float tiles; // texture coordinates → tiles
uniform float layers; // K: slabs stored
uniform float slabsPerShell; // K / n: how much fur one drawn shell stands for

out vec3 vAt; // XY = tiles, Z = slab
out float vWeight; // slabs that the shell stands for here, of the patch's share
out float vFacing; // n·v

struct ShellPoint {
	float s; // 0 at the skin, 1 at the tip
	vec3 normal; // of the skin, the mesh's own axes
	mat3 turn; // the mesh's own axes → view space, without scale
	mat3 frameVS; // (T, B, N), bent with the hair
	vec3 pointVS;
};

mat4 bodyModelView() {
#ifdef BODIES
	return modelViewMatrix * body;
#else
	return modelViewMatrix;
#endif
}

// Places the vertex and writes what every fragment of a shell needs, whatever it is lit by.
ShellPoint shellPoint() {
	ShellPoint point;
	mat4 placement = bodyModelView();
	point.s = shell.x;
	vec3 n = normalize(normal);
	vec3 t = normalize(tangent.xyz - n * dot(n, tangent.xyz));
	point.normal = n;
	point.turn = mat3(placement) / length(placement[0].xyz);
	point.frameVS = point.turn * furBend(n, _comb, point.s) * mat3(t, tangent.w * cross(n, t), n);
	point.pointVS = (placement * vec4(furPoint(position, n, _comb, _fur.y, point.s), 1.0)).xyz;

	vAt = vec3(uv * tiles - shell.zw, shell.y);
	// The outermost shell may stand for less than the others, where their number is between two whole ones.
	vWeight = _fur.x * min(slabsPerShell, 2.0 * (1.0 - point.s) * layers);
	vFacing = dot(point.turn * n, normalize(-point.pointVS));
	gl_Position = projectionMatrix * vec4(point.pointVS, 1.0);
	return point;
}
