// Arrival of a lamp's light at a point of the body.

// Share of the dip left below a lamp, 1 above the horizon. height: lamp over the horizon
float horizonShare(FurPoint point, float height, float radius) {
	return height < 0.0 ? clamp(1.0 + height / horizonDip(point, radius), 0.0, 1.0) : 1.0;
}

Arrival arrivalAt(FurPoint point, Eye from, Bending bending, vec3 lightVS) {
	vec3 lightTS = lightVS * point.frameVS;
	Arrival at;
	at.radius = radiusTowards(point, lightTS);
	at.height = lightTS.UP;
	at.surge = surgeTowards(from, throughPelt(point, lightTS));
	if (at.height < 0.0) {
		lightTS.UP = 0.0;
		lightTS /= max(length(lightTS), 1e-4);
	}
	at.lightTS = lightTS;
	at.surge *= alongLean(from, at.radius, lightTS, dot(viewerVS(point.pointVS), lightVS));
	at.curves = curvesAt(at.height, horizonShare(point, at.height, at.radius), at.radius, lightTS);
	at.nap = napTowards(from, bending.there ? unbent(lightTS, bending) : lightTS);
#ifdef CURVES
	basis(lightTS, at.low, at.high);
#endif
	return at;
}

#ifdef STORED_ARRIVALS
// Arrival stored for this vertex of the body. lamp: index of the directional lamp
Arrival storedArrival(int lamp) {
	ivec2 texel = bodyTexel(gl_VertexID, lamp);
	vec4 place = uintBitsToFloat(texelFetch(bodyLight0, texel, 0));
	vec3 lightTS;
	lightTS.x = place.z;
	lightTS[LEVEL] = place.w;
	lightTS.UP = max(place.x, 0.0);
	Arrival at;
	at.lightTS = lightTS;
	at.height = place.x;
	at.radius = place.y;
#ifdef CURVES
	uvec4 first = texelFetch(bodyLight1, texel, 0), second = texelFetch(bodyLight2, texel, 0);
	vec2 low = unpackHalf2x16(second.y), nap = unpackHalf2x16(first.z), middle = unpackHalf2x16(second.z);
	at.curves = vec4(unpackHalf2x16(first.x), unpackHalf2x16(first.y));
	at.nap = vec3(nap, unpackHalf2x16(first.w).x);
	at.surge = unpackHalf2x16(first.w).y;
	at.low = vec3(low, middle.x);
	at.high = vec3(middle.y, unpackHalf2x16(second.w));
#else
	vec4 nap = uintBitsToFloat(texelFetch(bodyLight2, texel, 0));
	at.curves = uintBitsToFloat(texelFetch(bodyLight1, texel, 0));
	at.nap = nap.xyz;
	at.surge = nap.w;
#endif
	return at;
}
#endif
