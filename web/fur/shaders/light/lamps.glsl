// Light of lamps at a point of the fur: three's directional, point and spot lights, with their shadow maps.

#ifdef GLOSS
uniform float sharpness; // exponent of the white highlight; the coloured one's is a quarter of it
#endif

struct Lamps {
	LampMoments moments;
	Strength back; // light that comes through the hairs from behind
	vec2 lobes; // highlights: white, of the hair's colour; times the lamps' light on the texel
#ifdef TINGED
	vec4 tinge; // RGB = sum with the colour of light that has met several hairs; A = light in that sum
#endif
#ifdef WET
	float power; // irradiance
#endif
#ifdef SHADOW_PER_FRAGMENT
	vec3 place; // place in the first directional lamp's shadow map, see shadowPlace
#ifdef SHADOW_SHARE
	float share; // share of that lamp in the light of all
#endif
#endif
};

#ifdef ONE_HUE
#define NO_MOMENTS LampMoments(vec3(0.0), vec3(0.0))
#else
#define NO_MOMENTS LampMoments(mat3(0.0), mat3(0.0))
#endif
#ifdef TINGED
#define NO_TINGE , vec4(1e-4) // for lamps too faint for their colour to matter
#else
#define NO_TINGE
#endif
#ifdef WET
#define NO_POWER , 0.0
#else
#define NO_POWER
#endif
#if defined(SHADOW_SHARE)
#define NO_SHADOW , vec3(2.0), 0.0
#elif defined(SHADOW_PER_FRAGMENT)
#define NO_SHADOW , vec3(2.0)
#else
#define NO_SHADOW
#endif
#define DARKNESS Lamps(NO_MOMENTS, Strength(0.0), vec2(0.0) NO_TINGE NO_POWER NO_SHADOW)

// Unit vector along the hairs.
vec3 strandVS(FurPoint point) {
	vec3 along = 2.0 * point.s * point.comb;
	along.UP = sqrt(max(1.0 - dot(point.comb, point.comb), 0.0));
#ifndef FIN
	along.xy += 2.0 * point.s * lean;
#endif
	return point.frameVS * normalize(along);
}

// Kajiya and Kay 1989 with the half vector; two lobes leaned to the tip and to the root (Marschner et al. 2003), since a
// hair's scales tilt its surface reflection one way and the light back through it the other.
vec2 highlights(vec3 strand, vec3 normalVS, vec3 light, vec3 viewer) {
#ifdef GLOSS
	vec3 halfway = normalize(light + viewer);
	vec2 along = vec2(dot(normalize(strand - 0.1 * normalVS), halfway), dot(normalize(strand + 0.2 * normalVS), halfway));
	vec2 across = sqrt(max(1.0 - along * along, 0.0));
#ifdef WET
	float exponent = sharpness * furTraits.w;
#else
	float exponent = sharpness;
#endif
	return smoothstep(-1.0, 0.0, along) * vec2(pow(across.x, exponent), pow(across.y, 0.25 * exponent));
#else
	return vec2(0.0);
#endif
}

// many: share left of light that has met several hairs.
void addLamp(inout Lamps lamps, inout float power, FurPoint point, Bending bending, Arrival at, vec3 many, vec3 lightVS, vec3 irradiance) {
	vec3 lightTS = at.lightTS;
	vec4 curves = at.curves;
	float nap = napAt(at, point.s), gain = nap * at.surge, left = horizonShare(point, at.height, at.radius);
#ifndef UNBENT
	if (bending.there) {
		gain *= bentLight(lightTS, bending);
		curves = curvesAt(at.height < 0.0 ? at.height : lightTS.UP, left, at.radius, lightTS);
	}
#endif
	float reaching = meanLight(point, curves);
	gain *= reaching;
	vec3 low, high;
#if defined(CURVES) && defined(UNBENT)
	low = at.low;
	high = at.high;
#else
	basis(lightTS, low, high);
#endif
	float luminance = dot(irradiance, LUMINANCE);
#ifdef SHADOW_SHARE
	lamps.share += max(gain, 0.0) * luminance;
#endif
#ifdef ONE_HUE
	float strength = luminance;
	lamps.moments.low += (gain * strength) * low;
	lamps.moments.high += (gain * strength) * high;
#ifdef TINGED
	lamps.tinge += max(gain * strength, 0.0) * vec4(lampTinge(point, many, at, lightVS, nap), 1.0);
#endif
#else
	vec3 strength = irradiance, coloured = gain * strength;
#ifdef MULTIPLE
	coloured *= lampTinge(point, many, at, lightVS, nap);
#endif
	lamps.moments.low += outerProduct(coloured, low);
	lamps.moments.high += outerProduct(coloured, high);
#endif
#if defined(GLOSS) || defined(BACKLIGHT)
	vec3 strand = strandVS(point), viewer = viewerVS(point.pointVS);
	float share = sqrt(left) * luminance;
	power += share;
	lamps.lobes += share * highlights(strand, point.frameVS[UPRIGHT], lightVS, viewer);
	float through = max(-dot(viewer, lightVS), 0.0);
	lamps.back += (max(reaching, 0.0) * strength) * (through * through * through * length(cross(strand, lightVS)) * point.s);
#endif
}

#ifdef GLOWING
// The fur is lit as from straight above: light leaves the skin to all sides.
void addGlow(inout Lamps lamps, FurPoint point, float through, vec3 irradiance) {
	if (through <= 0.0) return;
	vec3 up = vec3(0.0), low, high;
	up.UP = 1.0;
	basis(up, low, high);
	vec3 light = max(through * meanLight(point, curvesAt(1.0, 1.0, radiusTowards(point, up), up)), 0.0) * irradiance * SKIN;
#ifdef ONE_HUE
	float strength = dot(light, LUMINANCE);
	lamps.moments.low += strength * low;
	lamps.moments.high += strength * high;
#ifdef TINGED
	lamps.tinge += vec4(strength * SKIN / dot(SKIN, LUMINANCE), strength);
#endif
#else
	lamps.moments.low += outerProduct(light, low);
	lamps.moments.high += outerProduct(light, high);
#endif
}
#endif

#ifdef STORED_ARRIVALS
#define DIRECTIONAL_ARRIVAL(i) storedArrival(i)
#else
#define DIRECTIONAL_ARRIVAL(i) arrivalAt(point, from, bending, light.direction)
#endif

Lamps lampsAt(FurPoint point, Bending bending) {
	Lamps lamps = DARKNESS;
	IncidentLight light;
	float power = 0.0;
	Eye from = eyeAt(point, bending);
#ifdef SHADOW_SHARE
	float first = 0.0;
#endif
#ifdef MULTIPLE
	vec3 many = multipleGain(point);
#else
	vec3 many = vec3(1.0);
#endif
#if NUM_DIR_LIGHTS > 0
	#pragma unroll_loop_start
	for (int i = 0; i < NUM_DIR_LIGHTS; i++) {
		getDirectionalLightInfo(directionalLights[ i ], light);
#if defined(SHADOW_PER_FRAGMENT) && (UNROLLED_LOOP_INDEX == 0)
		lamps.place = shadowPlace(directionalShadowMatrix[ i ], directionalLightShadows[ i ].shadowBias, 1.0 / directionalLightShadows[ i ].shadowMapSize.x, point, light.direction);
#elif defined(USE_SHADOWMAP) && (UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS)
		light.color *= shadow(directionalShadowMap[ i ], directionalLightShadows[ i ].shadowMapSize, directionalLightShadows[ i ].shadowIntensity, directionalLightShadows[ i ].shadowRadius, shadowPlace(directionalShadowMatrix[ i ], directionalLightShadows[ i ].shadowBias, directionalLightShadows[ i ].shadowRadius / directionalLightShadows[ i ].shadowMapSize.x, point, light.direction));
#endif
		addLamp(lamps, power, point, bending, DIRECTIONAL_ARRIVAL(UNROLLED_LOOP_INDEX), many, light.direction, light.color);
#if defined(SHADOW_SHARE) && (UNROLLED_LOOP_INDEX == 0)
		first = lamps.share;
#endif
#if defined(GLOWING) && (UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS)
		addGlow(lamps, point, glowThrough(directionalShadowMap[ i ], directionalShadowMatrix[ i ], directionalLightShadows[ i ].shadowBias, point, light.direction), light.color);
#endif
	}
	#pragma unroll_loop_end
#endif
#if NUM_POINT_LIGHTS > 0
	for (int i = 0; i < NUM_POINT_LIGHTS; i++) {
		getPointLightInfo(pointLights[i], point.pointVS, light);
		addLamp(lamps, power, point, bending, arrivalAt(point, from, bending, light.direction), many, light.direction, light.color);
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	#pragma unroll_loop_start
	for (int i = 0; i < NUM_SPOT_LIGHTS; i++) {
		getSpotLightInfo(spotLights[ i ], point.pointVS, light);
#if defined(USE_SHADOWMAP) && (UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS)
		light.color *= shadow(spotShadowMap[ i ], spotLightShadows[ i ].shadowMapSize, spotLightShadows[ i ].shadowIntensity, spotLightShadows[ i ].shadowRadius, shadowPlace(spotLightMatrix[ i ], spotLightShadows[ i ].shadowBias, spotLightShadows[ i ].shadowRadius / spotLightShadows[ i ].shadowMapSize.x, point, light.direction));
#endif
		addLamp(lamps, power, point, bending, arrivalAt(point, from, bending, light.direction), many, light.direction, light.color);
	}
	#pragma unroll_loop_end
#endif
#ifdef SHADOW_SHARE
	lamps.share = first / max(lamps.share, 1e-6);
#endif
	lamps.lobes /= max(power, 1e-6);
#ifdef TINGED
	lamps.tinge /= lamps.tinge.w;
#endif
#ifdef WET
	lamps.lobes *= furTraits.z;
	lamps.power = power;
#endif
#ifdef TRIMMED
	lamps.lobes *= furTrim; // stubble shows its ends more than its sides
	lamps.moments = trimmed(lamps.moments, point.s);
#endif
	return lamps;
}
