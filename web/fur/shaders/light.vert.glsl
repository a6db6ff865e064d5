// What of the light goes from vertex to fragment: moments, summed here; or, where lamps are summed per fragment, the point.
// WebGL2 promises no more than 15 vectors: of a shell four matrices and three vec3, with fifteen scalars in their gaps; where lamps are summed per
// fragment three matrices, three vec3 and sixteen scalars.

#ifdef SKY
out mat3 vSkyLow;
#ifdef TWO_PLANES
out mat3 vSkyHigh;
#endif
#endif
#ifdef LAMPS_PER_FRAGMENT
out mat3 vFrame;
out vec3 vPoint;
out float vReach;
out float vS;
#ifdef MEAN_CURVES
out float vSlab;
out float vCurvatureX;
out float vCurvatureY;
out float vCurvatureXY;
#endif
out float vCombX; // along the first axis of the frame
out float vCombY; // along the other level one
#else
// Light moments of coefficients 0..2 (low) and 3..5 (high), a column each.
#ifdef ONE_HUE
out vec3 vLampLow;
#ifdef TWO_PLANES
out vec3 vLampHigh;
#endif
#else
out mat3 vLampLow;
#ifdef TWO_PLANES
out mat3 vLampHigh;
#endif
#endif
#ifdef SHADOW_PER_FRAGMENT
out float vShadowX;
out float vShadowY;
out float vShadowZ;
#ifdef SHADOW_SHARE
out float vShadowShare;
#endif
#endif
#ifdef TINGED
out vec3 vTinge;
#endif
#ifdef BACKLIGHT
out Strength vBack;
#endif
#ifdef GLOSS
out float vLobe; // white highlight
out float vTintedLobe;
#ifdef WET
out float vPower; // irradiance
#endif
#endif
#endif

layout(location = 10) in vec3 curvature; // of the skin, per the mesh's own unit: along the frame's first axis, along the other level one, mixed

// Per length of the hair, which is this share of the longest.
vec3 furCurvature(float lengthShare) {
#ifdef WET
	lengthShare *= furTraits.x;
#endif
	return curvature * (furLength * lengthShare);
}

// Of the hair, world units.
float furReach(float lengthShare) {
#ifdef WET
	lengthShare *= furTraits.x;
#endif
	return furLength * lengthShare * length(bodyModel()[0].xyz);
}

// openness: to the sky, 0..1.
void passLight(FurPoint point, float openness) {
	Bending bending = bendingOf(point.comb, point.s);
	Quadratic seen = seenByEye(point);
#ifdef SKY
	Moments sky = environmentMoments(point, bending, seen);
	vSkyLow = sky.low * openness;
#ifdef TWO_PLANES
	vSkyHigh = sky.high * openness;
#endif
#endif
#ifdef LAMPS_PER_FRAGMENT
	vFrame = point.frameVS;
	vCombX = point.comb.x;
	vCombY = point.comb[LEVEL];
	vPoint = point.pointVS;
	vReach = point.reach;
	vS = point.s;
#ifdef MEAN_CURVES
	vSlab = point.slab;
	vCurvatureX = point.curvature.x;
	vCurvatureY = point.curvature.y;
	vCurvatureXY = point.curvature.z;
#endif
#else
	Lamps lamps = lampsAt(point, bending, seen);
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

// For what nobody sees.
void passDarkness() {
#ifdef SKY
	vSkyLow = mat3(0.0);
#ifdef TWO_PLANES
	vSkyHigh = mat3(0.0);
#endif
#endif
#ifdef LAMPS_PER_FRAGMENT
	vFrame = mat3(1.0);
	vPoint = vec3(0.0);
	vS = vReach = vCombX = vCombY = 0.0;
#ifdef MEAN_CURVES
	vSlab = vCurvatureX = vCurvatureY = vCurvatureXY = 0.0;
#endif
#else
	vLampLow = NO_MOMENTS.low;
#ifdef TWO_PLANES
	vLampHigh = NO_MOMENTS.high;
#endif
#ifdef SHADOW_PER_FRAGMENT
	vShadowX = vShadowY = vShadowZ = 2.0;
#ifdef SHADOW_SHARE
	vShadowShare = 0.0;
#endif
#endif
#ifdef TINGED
	vTinge = vec3(1.0);
#endif
#ifdef BACKLIGHT
	vBack = Strength(0.0);
#endif
#ifdef GLOSS
	vLobe = vTintedLobe = 0.0;
#ifdef WET
	vPower = 0.0;
#endif
#endif
#endif
}
