in vec4 tangent;
in float _weight; // lapped weight, 0..1
in float _length; // share of the longest fur, 0..1
in vec4 shell; // per instance: X = s of the shell, Y = slab it shows, ZW = shear of the look-up, tile widths

out vec2 vUv;
out float vWeight;
out vec3 vNormalVS;
out vec3 vViewVS;
// Light moments of coefficients 0..2 (low) and 3..5 (high), a column each.
out mat3 vLampLow;
out mat3 vLampHigh;
out mat3 vSkyLow;
out mat3 vSkyHigh;
flat out vec2 vShell; // X = s, Y = slab

void main() {
	float s = shell.x;
	vec4 pointVS = modelViewMatrix * vec4(furPoint(position, normal, _length, s), 1.0);
	vec3 n = normalize(normalMatrix * normal);
	vec3 t = mat3(modelViewMatrix) * tangent.xyz;
	t = normalize(t - n * dot(n, t));
	mat3 frameVS = mat3(t, tangent.w * cross(n, t), n);
	Moments lamps = lampMoments(frameVS, pointVS.xyz, s);
	Moments sky = environmentMoments(frameVS);
	vLampLow = lamps.low;
	vLampHigh = lamps.high;
	vSkyLow = sky.low;
	vSkyHigh = sky.high;
	vUv = uv - shell.zw;
	vWeight = _weight;
	vNormalVS = n;
	vViewVS = -pointVS.xyz;
	vShell = shell.xy;
	gl_Position = projectionMatrix * pointVS;
}
