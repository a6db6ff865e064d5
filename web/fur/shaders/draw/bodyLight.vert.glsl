uniform vec2 texels; // size of the target, texels

flat out uvec4 vEntry0;
flat out uvec4 vEntry1;
flat out uvec4 vEntry2;

void main() {
	takePose();
	feelWeather();
	mat3 frame = skinFrame();
	mat4 placement = bodyModelView();
	int height = gl_InstanceID - NUM_DIR_LIGHTS;
	FurPoint point;
	point.frameVS = mat3(placement) / length(placement[0].xyz) * frame;
	point.slab = float(storedSlab(max(height, 0)));
	// Half the hair's height stands for all heights under a lamp.
	point.s = height < 0 ? 0.5 * furTrim : min((point.slab + 0.5) / float(LAYERS), furTrim);
	vec3 comb = furComb(_comb);
	point.pointVS = (placement * vec4(furPoint(rootPosition, frame[2], comb, _fur.y, point.s), 1.0)).xyz;
	point.curvature = furCurvature(_fur.y);
	point.share = hairShare(_fur.y);
	point.comb = comb * frame;
	Bending bending = bendingOf(point.comb, point.s);
	if (height < 0) {
#if NUM_DIR_LIGHTS > 0
		Arrival at = arrivalAt(point, eyeAt(point, bending), bending, directionalLights[gl_InstanceID].direction);
		vEntry0 = floatBitsToUint(vec4(at.height, at.radius, at.lightTS.x, at.lightTS[LEVEL]));
#ifdef CURVES
		vEntry1 = uvec4(packHalf2x16(at.curves.xy), packHalf2x16(at.curves.zw), packHalf2x16(at.nap.xy), packHalf2x16(vec2(at.nap.z, at.surge)));
		vEntry2 = uvec4(0u, packHalf2x16(at.low.xy), packHalf2x16(vec2(at.low.z, at.high.x)), packHalf2x16(at.high.yz));
#else
		vEntry1 = floatBitsToUint(at.curves);
		vEntry2 = floatBitsToUint(vec4(at.nap, at.surge));
#endif
#endif
	} else {
#ifdef SKY
		packSky(skyAt(point, bending), evenSky(point, skyPlace(point)), vEntry0, vEntry1);
		vEntry2 = uvec4(0u);
#endif
	}
	gl_PointSize = 1.0;
	gl_Position = vec4((vec2(bodyTexel(gl_VertexID, gl_InstanceID)) + 0.5) / texels * 2.0 - 1.0, 0.0, 1.0);
}
