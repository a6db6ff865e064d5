// Light as an eye beside the hair sees it. Texels hold what is seen from straight above; from aside other hairs are seen,
// and other sides of them. The law is that of pelt/eye.py, with numbers that every bake finds for its own fur.

#ifdef EYE
uniform vec4 eye[9]; // weights of twelve terms, three vectors for each of 1, s, s²
uniform vec4 surge; // Light of a lamp beside the eye, which sees no shadows: how much more it is, X from above, X + Y from aside; Z = width of that, radians; W = share of a half sphere that it takes up
#endif

// What light from a direction counts for the eye, before it is held at LEAST_SEEN.
Quadratic seenByEye(FurPoint point) {
	Quadratic seen = Quadratic(1.0, vec3(0.0), mat3(0.0));
#ifdef EYE
	vec3 level = viewerVS(point.pointVS) * point.frameVS, upright = vec3(0.0), leaning = leanTS();
	bool below = level.UP < 0.0; // its horizon: the eye is held on it
	level.UP = 0.0;
	upright.UP = 1.0;
	if (below) level /= max(length(level), 1e-4);
	float q = dot(level, level), p = dot(level, leaning), s = point.s / furTrim;
	// In the order of the format, with a = level·l, b = leaning·l: q, a, q·b, p·b; q·z, q·b², p, a²; p·a·b, a·z, q·b·z, q·a·b.
	vec4 first = eye[0] + s * (eye[3] + s * eye[6]), second = eye[1] + s * (eye[4] + s * eye[7]), third = eye[2] + s * (eye[5] + s * eye[8]);
	seen.even += first.x * q + second.z * p;
	seen.gradient = first.y * level + (first.z * q + first.w * p) * leaning + second.x * q * upright;
	seen.form = outerProduct(second.w * level + (third.x * p + third.w * q) * leaning + third.y * upright, level);
	seen.form += outerProduct(q * (second.y * leaning + third.z * upright), leaning);
#endif
	return seen;
}

#define LEAST_SEEN 0.1

// lightTS: not below the horizon.
float heldNap(Quadratic seen, vec3 lightTS) {
#ifdef EYE
	return max(quadratic(seen, lightTS), LEAST_SEEN);
#else
	return 1.0;
#endif
}

#ifdef EYE
// How much more light beside the eye counts. up: height of the eye over the horizon
float surgeFrom(float up) {
	return surge.x + surge.y * (1.0 - up * up);
}
#endif

// lightTS: held on the horizon. lightVS: where it is.
float seenOf(Quadratic seen, FurPoint point, vec3 lightTS, vec3 lightVS) {
#ifdef EYE
	vec3 viewer = viewerVS(point.pointVS), apart = (lightVS - viewer) / surge.z;
	float up = max(dot(viewer, point.frameVS[UPRIGHT]), 0.0);
	return heldNap(seen, lightTS) * (1.0 + surgeFrom(up) / (1.0 + dot(apart, apart)));
#else
	return 1.0;
#endif
}
