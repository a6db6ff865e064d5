// How much of a lamp reaches a point of the fur past other parts of the scene: three's shadow maps, filtered over a disc
// of the light's own radius. What the fur itself shades is in the polynomials, and what the body below it shades as far as
// it is round: so taps ask what stands before the ball on which the hair's tip lies, not before the tip.

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

// matrix: the world's axes → the map's.
float shadow(ShadowMap map, vec2 size, float intensity, float bias, float radius, mat4 matrix, FurPoint point, vec3 lightVS) {
	vec4 place = matrix * vec4(point.tipWS, 1.0);
	vec3 at = place.xyz / place.w;
	at.z += bias;
	mat4 rows = transpose(matrix);
	mat3 slopes = mat3(rows[0].xyz, rows[1].xyz, rows[2].xyz) - outerProduct(rows[3].xyz, at);
	slopes /= place.w; // of X, Y and depth of the map, per unit of the world
	vec3 lightWS = lightVS * mat3(viewMatrix), normalWS = point.frameVS[UPRIGHT] * mat3(viewMatrix);
	float ball = point.reach * (radiusTowards(point, lightVS * point.frameVS) + 1.0), height = dot(normalWS, lightWS);
	vec3 aside = ball * (normalWS - height * lightWS); // from the ball's axis to the tip
	vec3 right = slopes[0] / dot(slopes[0], slopes[0]), up = slopes[1] / dot(slopes[1], slopes[1]);
	float deeper = dot(slopes[2], lightWS);
	// Half a turn's golden angle from tap to tap fills the disc evenly.
	float sum = 0.0;
	for (int i = 0; i < SHADOW_TAPS; i++) {
		float r = sqrt((float(i) + 0.5) / float(SHADOW_TAPS)), angle = 2.3999632 * float(i);
		vec2 offset = r * radius / size * vec2(cos(angle), sin(angle));
		vec3 away = aside + offset.x * right + offset.y * up;
		float rise = sqrt(max(ball * ball - dot(away, away), 0.0)) - ball * height;
		sum += shadowTap(map, at + vec3(offset, rise * deeper));
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
