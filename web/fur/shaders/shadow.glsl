// How much of a lamp reaches a point of the fur past other parts of the scene: three's shadow maps, filtered over a disc
// of the light's own radius. What the fur itself shades is in the polynomials.

#if defined(USE_SHADOWMAP) && (NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SPOT_LIGHT_SHADOWS > 0)

#define SHADOW_TAPS 9

#if defined(SHADOWMAP_TYPE_PCF)
#define ShadowMap sampler2DShadow
#else
#define ShadowMap sampler2D
#endif

// Share of the light that a tap lets through; XY of the map, Z = depth in it.
float shadowTap(ShadowMap map, vec3 at) {
#if defined(SHADOWMAP_TYPE_PCF)
	return texture(map, at);
#elif defined(SHADOWMAP_TYPE_VSM)
	// Chebyshev's bound from the mean and the standard deviation of depth.
	vec2 depths = texture(map, at.xy).xy;
	float beyond = max(at.z - depths.x, 0.0), variance = max(depths.y * depths.y, 1e-7);
	return variance / (variance + beyond * beyond);
#else
	return step(at.z, texture(map, at.xy).x);
#endif
}

float shadow(ShadowMap map, vec2 size, float intensity, float bias, float radius, vec4 place) {
	vec3 at = place.xyz / place.w;
	at.z += bias;
	// Half a turn's golden angle from tap to tap fills the disc evenly.
	float sum = 0.0;
	for (int i = 0; i < SHADOW_TAPS; i++) {
		float r = sqrt((float(i) + 0.5) / float(SHADOW_TAPS)), angle = 2.3999632 * float(i);
		sum += shadowTap(map, at + vec3(r * radius / size * vec2(cos(angle), sin(angle)), 0.0));
	}
	bool mapped = all(greaterThan(at, vec3(0.0))) && all(lessThan(at, vec3(1.0)));
	return receiveShadow && mapped ? mix(1.0, sum / float(SHADOW_TAPS), intensity) : 1.0;
}

#if NUM_DIR_LIGHT_SHADOWS > 0
struct DirectionalLightShadow {
	float shadowIntensity;
	float shadowBias;
	float shadowNormalBias;
	float shadowRadius;
	vec2 shadowMapSize;
};
uniform DirectionalLightShadow directionalLightShadows[NUM_DIR_LIGHT_SHADOWS];
uniform mat4 directionalShadowMatrix[NUM_DIR_LIGHT_SHADOWS];
uniform ShadowMap directionalShadowMap[NUM_DIR_LIGHT_SHADOWS];
#endif

#if NUM_SPOT_LIGHT_SHADOWS > 0
struct SpotLightShadow {
	float shadowIntensity;
	float shadowBias;
	float shadowNormalBias;
	float shadowRadius;
	vec2 shadowMapSize;
};
uniform SpotLightShadow spotLightShadows[NUM_SPOT_LIGHT_SHADOWS];
uniform mat4 spotLightMatrix[NUM_SPOT_LIGHT_COORDS];
uniform ShadowMap spotShadowMap[NUM_SPOT_LIGHT_SHADOWS];
#endif

#endif
