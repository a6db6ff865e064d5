// Light from the vertices: see light.vert.glsl.

#ifdef SKY
centroid in vec3 vSkyLow;
#ifdef TWO_PLANES
centroid in vec3 vSkyHigh;
#endif
centroid in vec3 vSkyHue;
#endif
#ifdef LAMPS_PER_FRAGMENT
in mat3 vFrame;
in vec3 vPoint;
in float vReach;
in float vShare;
in float vS;
#ifdef MEAN_CURVES
in float vSlab;
in float vCurvatureX;
in float vCurvatureY;
in float vCurvatureXY;
#endif
in float vCombX;
in float vCombY;
#else
#ifdef ONE_HUE
centroid in vec3 vLampLow;
#ifdef TWO_PLANES
centroid in vec3 vLampHigh;
#endif
#else
centroid in mat3 vLampLow;
#ifdef TWO_PLANES
centroid in mat3 vLampHigh;
#endif
#endif
#ifdef SHADOW_PER_FRAGMENT
centroid in float vShadowX;
centroid in float vShadowY;
centroid in float vShadowZ;
#ifdef SHADOW_SHARE
centroid in float vShadowShare;
#endif
#endif
#ifdef TINGED
centroid in vec3 vTinge;
#endif
#ifdef BACKLIGHT
centroid in Strength vBack;
#endif
#ifdef GLOSS
centroid in float vLobe;
centroid in float vTintedLobe;
#ifdef WET
centroid in float vPower;
#endif
#endif
#endif

Lamps receivedLamps() {
#ifdef LAMPS_PER_FRAGMENT
	vec3 comb = vec3(vCombX, 0.0, 0.0);
	comb[LEVEL] = vCombY;
#ifdef MEAN_CURVES
	FurPoint point = FurPoint(vFrame, comb, vPoint, vReach, vShare, vS, vSlab, vec3(vCurvatureX, vCurvatureY, vCurvatureXY));
#else
	FurPoint point = FurPoint(vFrame, comb, vPoint, vReach, vShare, vS, 0.0, vec3(0.0));
#endif
	return lampsAt(point, bendingOf(comb, vS));
#else
	Lamps lamps = DARKNESS;
	lamps.moments.low = vLampLow;
#ifdef TWO_PLANES
	lamps.moments.high = vLampHigh;
#endif
#ifdef TINGED
	lamps.tinge.rgb = vTinge;
#endif
#ifdef BACKLIGHT
	lamps.back = vBack;
#endif
#ifdef GLOSS
	lamps.lobes = vec2(vLobe, vTintedLobe);
#ifdef WET
	lamps.power = vPower;
#endif
#endif
#ifdef SHADOW_PER_FRAGMENT
	lamps.place = vec3(vShadowX, vShadowY, vShadowZ);
#ifdef SHADOW_SHARE
	lamps.share = vShadowShare;
#endif
#endif
	return lamps;
#endif
}

SkyLight receivedSky() {
	SkyLight sky = SkyLight(Strengths(vec3(0.0), vec3(0.0)), vec3(0.0));
#ifdef SKY
	sky.moments.low = vSkyLow;
#ifdef TWO_PLANES
	sky.moments.high = vSkyHigh;
#endif
	sky.hue = vSkyHue;
#endif
	return sky;
}
