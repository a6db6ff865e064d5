// Light from vertex to fragment: moments, summed here; or, where lamps are summed per fragment, the point.
// WebGL2 guarantees 15 vectors, and a test counts them. All are taken at the centroid of the samples that a
// triangle covers: beyond its edge a multisampled pixel would be far too bright. Places in textures are not, whose derivatives
// choose a level, and vKept in the gap beside them.

#ifdef SKY
centroid out vec3 vSkyLow;
#ifdef TWO_PLANES
centroid out vec3 vSkyHigh;
#endif
centroid out vec3 vSkyHue;
#endif
#ifdef LAMPS_PER_FRAGMENT
out mat3 vFrame;
out vec3 vPoint;
out float vReach;
out float vShare;
out float vS;
#ifdef MEAN_CURVES
out float vSlab;
out float vCurvatureX;
out float vCurvatureY;
out float vCurvatureXY;
#endif
out float vCombX; // comb along the frame's first level axis
out float vCombY; // comb along the second
#else
// Light moments of coefficients 0..2 (low) and 3..5 (high), a column each.
#ifdef ONE_HUE
centroid out vec3 vLampLow;
#ifdef TWO_PLANES
centroid out vec3 vLampHigh;
#endif
#else
centroid out mat3 vLampLow;
#ifdef TWO_PLANES
centroid out mat3 vLampHigh;
#endif
#endif
#ifdef SHADOW_PER_FRAGMENT
centroid out float vShadowX;
centroid out float vShadowY;
centroid out float vShadowZ;
#ifdef SHADOW_SHARE
centroid out float vShadowShare;
#endif
#endif
#ifdef TINGED
centroid out vec3 vTinge;
#endif
#ifdef BACKLIGHT
centroid out Strength vBack;
#endif
#ifdef GLOSS
centroid out float vLobe; // white highlight
centroid out float vTintedLobe;
#ifdef WET
centroid out float vPower; // irradiance
#endif
#endif
#endif

// seen: whether the vertex is visible; else it stays dark. openness: to the sky, 0..1.
void passLight(bool seen, FurPoint point, float openness) {
#ifdef SKY
	SkyLight sky = SkyLight(Strengths(vec3(0.0), vec3(0.0)), vec3(0.0));
#endif
#ifndef LAMPS_PER_FRAGMENT
	Lamps lamps = DARKNESS;
#ifdef TINGED
	lamps.tinge = vec4(1.0);
#endif
#endif
	if (seen) {
		Bending bending = bendingOf(point.comb, point.s);
#ifdef SKY
		sky = skyLight(point, bending);
#endif
#ifndef LAMPS_PER_FRAGMENT
		lamps = lampsAt(point, bending);
#endif
	}
#ifdef SKY
	vSkyLow = sky.moments.low * openness;
#ifdef TWO_PLANES
	vSkyHigh = sky.moments.high * openness;
#endif
	vSkyHue = sky.hue;
#endif
#ifdef LAMPS_PER_FRAGMENT
	vFrame = point.frameVS;
	vCombX = point.comb.x;
	vCombY = point.comb[LEVEL];
	vPoint = point.pointVS;
	vReach = point.reach;
	vShare = point.share;
	vS = point.s;
#ifdef MEAN_CURVES
	vSlab = point.slab;
	vCurvatureX = point.curvature.x;
	vCurvatureY = point.curvature.y;
	vCurvatureXY = point.curvature.z;
#endif
#else
	vLampLow = lamps.moments.low;
#ifdef TWO_PLANES
	vLampHigh = lamps.moments.high;
#endif
#ifdef SHADOW_PER_FRAGMENT
	vShadowX = lamps.place.x;
	vShadowY = lamps.place.y;
	vShadowZ = lamps.place.z;
#ifdef SHADOW_SHARE
	vShadowShare = lamps.share;
#endif
#endif
#ifdef TINGED
	vTinge = lamps.tinge.rgb;
#endif
#ifdef BACKLIGHT
	vBack = lamps.back;
#endif
#ifdef GLOSS
	vLobe = lamps.lobes.x;
	vTintedLobe = lamps.lobes.y;
#ifdef WET
	vPower = lamps.power;
#endif
#endif
#endif
}
