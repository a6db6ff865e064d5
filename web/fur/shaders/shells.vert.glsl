in vec4 tangent;
in vec4 color; // of the skin, linear
in vec4 _fur; // X = lapped weight, Y = share of the longest fur, Z = openness to the sky, W = from tip to tip2, all 0..1
in vec3 _comb; // displacement of the tip in the tangent plane, share of the length, the mesh's own axes
in vec4 shell; // per instance: X = s of the shell, Y = slab it shows, ZW = shear of the look-up, tile widths

uniform float tiles; // texture coordinates → tiles

// WebGL2 promises no more than 15 vectors: four matrices, two vec3 with the scalars in their gaps, and a vec4.
out vec3 vAt; // XY = tiles, Z = slab
out vec3 vColour; // of the hairs but for the texel's tint, linear
#ifdef COLOUR_PLANE
out vec4 vPlane; // RGB = factor of the texel's original colour, A = share of vColour
#endif
out float vWeight;
out float vFacing; // n·v
// Light moments of coefficients 0..2 (low) and 3..5 (high), a column each.
out mat3 vLampLow;
out mat3 vLampHigh;
out mat3 vSkyLow;
out mat3 vSkyHigh;

void main() {
	float s = shell.x;
	vec3 n = normalize(normal);
	vec3 t = normalize(tangent.xyz - n * dot(n, tangent.xyz));
	mat3 frame = mat3(t, tangent.w * cross(n, t), n);
	vec4 pointVS = modelViewMatrix * vec4(furPoint(position, n, _comb, _fur.y, s), 1.0);
	mat3 turn = mat3(modelViewMatrix) / length(modelViewMatrix[0].xyz);
	mat3 frameVS = turn * furBend(n, _comb, s) * frame;

	Moments lamps = lampMoments(frameVS, pointVS.xyz, s);
	Moments sky = environmentMoments(frameVS);
	vLampLow = lamps.low;
	vLampHigh = lamps.high;
	vSkyLow = sky.low * _fur.z;
	vSkyHigh = sky.high * _fur.z;

	vAt = vec3(uv * tiles - shell.zw, shell.y);
	vec3 skin = skinColour * color.rgb;
	vColour = skin * furRamp(_fur.w, s);
#ifdef COLOUR_PLANE
	vPlane = vec4(skin * (1.0 - _fur.w), _fur.w);
#endif
	vWeight = _fur.x;
	vFacing = dot(turn * n, normalize(-pointVS.xyz));
	gl_Position = projectionMatrix * pointVS;
}
