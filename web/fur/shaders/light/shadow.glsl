// Shadows of other parts of the scene on fur, by three's shadow maps. The polynomials already contain the fur's own shadows and
// those of the round body below. So maps are compared at the place where light leaves the ball of the hairs' tips, which
// projects to the point's own place in the map.
// The first directional lamp's shadow is read per fragment by one tap: path-traced edges are no softer. Others are read per
// vertex, filtered over a disc of the light's radius.

#if defined(USE_SHADOWMAP) && (NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SPOT_LIGHT_SHADOWS > 0)

#if NUM_DIR_LIGHT_SHADOWS > 0 && !defined(LAMPS_PER_FRAGMENT)
#define SHADOW_PER_FRAGMENT
#if NUM_DIR_LIGHTS + NUM_POINT_LIGHTS + NUM_SPOT_LIGHTS > 1
#define SHADOW_SHARE // uses that lamp's share of all light
#endif
#endif

#define SHADOW_TAPS 9

#if defined(SHADOWMAP_TYPE_PCF)
#define ShadowMap sampler2DShadow
#else
#define ShadowMap sampler2D
#endif

// Share of light past one tap. at: XY of the map, Z = depth in it.
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

// Place where light leaves the fur on its way from a point to the lamp, XY of the map and depth in it; far enough to clear the
// ball within `spread`, share of the map's width. Outside of the map if the point receives no shadows.
// matrix: world axes → the map's.
vec3 shadowPlace(mat4 matrix, float bias, float spread, FurPoint point, vec3 lightVS) {
	if (!receiveShadow) return vec3(2.0);
	vec3 pointWS = (point.pointVS - viewMatrix[3].xyz) * mat3(viewMatrix);
	vec3 across = vec3(matrix[0].x, matrix[1].x, matrix[2].x);
	spread *= dot(vec4(matrix[0].w, matrix[1].w, matrix[2].w, matrix[3].w), vec4(pointWS, 1.0)) / length(across);
	vec3 lightTS = lightVS * point.frameVS;
	float skin = point.reach * radiusTowards(point, lightTS), rise = point.reach * sqrt(max(1.0 - dot(point.comb, point.comb), 0.0));
	float tips = skin + rise, here = skin + rise * (point.s / furTrim), ahead = here * lightTS.UP;
	float aside = max(sqrt(max(here * here - ahead * ahead, 0.0)) - spread, 0.0);
	float way = sqrt(max(tips * tips - aside * aside, 0.0)) - ahead + spread;
	vec4 place = matrix * vec4(pointWS + way * (lightVS * mat3(viewMatrix)), 1.0);
	return place.xyz / place.w + vec3(0.0, 0.0, bias);
}

// Share of the light that reaches a place of the map, and `radius` texels around it.
float shadow(ShadowMap map, vec2 size, float intensity, float radius, vec3 at) {
	// Taps by the golden angle fill the disc evenly.
	float sum = 0.0;
	for (int i = 0; i < SHADOW_TAPS; i++) {
		float r = sqrt((float(i) + 0.5) / float(SHADOW_TAPS)), angle = 2.3999632 * float(i);
		sum += shadowTap(map, at + vec3(r * radius / size * vec2(cos(angle), sin(angle)), 0.0));
	}
	bool mapped = all(greaterThan(at, vec3(0.0))) && all(lessThan(at, vec3(1.0)));
	return mapped ? mix(1.0, sum / float(SHADOW_TAPS), intensity) : 1.0;
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

#ifdef SHADOW_PER_FRAGMENT
// Share of the first directional lamp's light that reaches a place of its map.
float firstShadow(vec3 at) {
	vec2 away = abs(at.xy - 0.5);
	if (max(away.x, away.y) > 0.5 || at.z > 1.0) return 1.0;
	return mix(1.0, shadowTap(directionalShadowMap[0], at), directionalLightShadows[0].shadowIntensity);
}
#endif
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
