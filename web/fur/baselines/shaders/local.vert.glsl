// Local light on the hairs, part per vertex: the sky's light, the light of lamps beyond the fourth, and directions of the
// first four in the hair's frame. Lengyel et al. 2001: fur is darker towards the roots.

#if NUM_DIR_LIGHTS > 4
#define LAMPS 4
#else
#define LAMPS NUM_DIR_LIGHTS
#endif

uniform vec2 lean; // mean displacement of the tips inside the tile, share of the length along (T, B)
uniform float diffuse; // brightness under a lamp, 4π·radiance / (albedo·irradiance)
uniform float skyDiffuse; // brightness under the sky, likewise
uniform vec2 darkness; // missing share at the roots of a lamp's light (X) and of the sky's (Y)

#ifdef MEAN_STRAND
flat out vec3 vStrand; // mean unit vector along the hairs, (T, B, N)
#endif
out vec3 vSoft; // light summed per vertex, unit of FurTexel
#if LAMPS > 0
out vec4 vLamp[LAMPS]; // XYZ = unit vector to the lamp, (T, B, N); W = share of its light that reaches the hair
#endif
#ifdef HIGHLIGHT
out vec3 vViewer; // unit vector to the eye, (T, B, N)
#endif

// Mean shade of the hairs, by height.
vec2 darkened(float s) {
	float depth = 1.0 - s / furTrim;
	return 1.0 - darkness * depth * depth;
}

// A body shades itself (D. C. Banks: Illumination in Diverse Codimensions, SIGGRAPH 1994), tips less than roots.
float lampShare(vec3 normalVS, vec3 lightVS, float s) {
	return smoothstep(-0.35 * s, 0.65, dot(normalVS, lightVS)) * darkened(s).x;
}

vec3 skyIrradiance(vec3 normalVS) {
	vec3 irradiance = ambientLightColor;
#if NUM_HEMI_LIGHTS > 0
	for (int i = 0; i < NUM_HEMI_LIGHTS; i++) irradiance += getHemisphereLightIrradiance(hemisphereLights[i], normalVS);
#endif
#ifdef USE_LIGHT_PROBES
	irradiance += getLightProbeIrradiance(lightProbe, normalVS);
#endif
	return irradiance;
}

// The frame bends with the hair: the smallest rotation that takes the normal onto the curve's tangent at s.
mat3 bentVS(ShellPoint shell) {
	vec3 along = normalize(vec3(2.0 * shell.s * shell.comb.xy, furRise(shell.comb)));
	vec3 both = vec3(along.xy, along.z + 1.0);
	mat3 bend = mat3(1.0) - outerProduct(both, both) / both.z;
	bend[2] += 2.0 * along;
	return shell.frameVS * bend;
}

// Adds a lamp's light on the hairs' mean direction, per vertex.
void addSoft(ShellPoint shell, mat3 frameVS, vec3 normalVS, vec3 strand, IncidentLight light) {
	float share = lampShare(normalVS, light.direction, shell.s);
	vSoft += light.color * (diffuse * share * kajiyaKayDiffuse(strand, light.direction * frameVS));
}

// openness: to the sky, 0..1. shaded: whether the first lamp's shadows are computed elsewhere.
void passLocalLight(ShellPoint shell, float openness, bool shaded) {
	mat3 frameVS = bentVS(shell);
	vec3 strand = normalize(vec3(2.0 * shell.s * lean, 1.0));
	vec3 normalVS = normalize(shell.turn * shell.normal);
	vSoft = skyIrradiance(normalVS) * (skyDiffuse * openness * darkened(shell.s).y);
#ifdef MEAN_STRAND
	vStrand = strand;
#endif
#ifdef HIGHLIGHT
	vViewer = viewerVS(shell.pointVS) * frameVS;
#endif
	IncidentLight light;
#if LAMPS > 0
	for (int i = 0; i < LAMPS; i++) {
		getDirectionalLightInfo(directionalLights[i], light);
		float share = shaded && i == 0 ? 1.0 : lampShare(normalVS, light.direction, shell.s);
		vLamp[i] = vec4(light.direction * frameVS, diffuse * share);
	}
#endif
#if NUM_DIR_LIGHTS > LAMPS
	for (int i = LAMPS; i < NUM_DIR_LIGHTS; i++) {
		getDirectionalLightInfo(directionalLights[i], light);
		addSoft(shell, frameVS, normalVS, strand, light);
	}
#endif
#if NUM_POINT_LIGHTS > 0
	for (int i = 0; i < NUM_POINT_LIGHTS; i++) {
		getPointLightInfo(pointLights[i], shell.pointVS, light);
		addSoft(shell, frameVS, normalVS, strand, light);
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	for (int i = 0; i < NUM_SPOT_LIGHTS; i++) {
		getSpotLightInfo(spotLights[i], shell.pointVS, light);
		addSoft(shell, frameVS, normalVS, strand, light);
	}
#endif
}
