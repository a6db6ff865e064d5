// Light seen by an eye from aside. Texels hold the view from straight above; from aside other hairs are seen, and other
// sides of them. By the law of pelt/eye.py, with numbers fitted by each bake.

#ifdef EYE
uniform vec4 eye[12 * FURS]; // weights of sixteen terms, fur after fur, four vectors for each of 1, s, s²; a fin's are its own
#if FURS > 1
uniform vec4 surges[FURS]; // surge of each fur
#define furSurge ofFur(surges, 1, 0)
#else
#define furSurge surge
uniform vec4 surge; // light of a lamp beside the eye, which sees no shadows: excess X seen from above, X + Y from aside; Z = width, radians; W = share of a half sphere
#endif
#endif

// Eye from a point of the body. Bent hairs are seen as unbent ones by an eye that is turned as their light is: a flank seen onto
// the tips then has .88 of the path tracer's light, without the turn .80.
struct Eye {
	vec3 viewer; // unit vector to it through the pelt, the frame's axes
	float up; // its height over the horizon, at least 0, as hairs that are not shorter see it
	vec3 level; // the horizontal part of that way, turned and clamped to the horizon, the frame's axes
	float q; // |level|²
	float p; // level·leaning
	float more; // excess of the nap on shorter hairs under any light, by pelt/short.py
	vec3 rise; // gradient of this excess by the light, the frame's axes
};

Eye eyeAt(FurPoint point, Bending bending) {
	Eye from;
	vec3 viewer = viewerVS(point.pointVS) * point.frameVS;
	from.viewer = throughPelt(point, viewer);
	viewer.UP = 0.0;
	from.rise = (1.0 - point.share) * viewer;
	from.more = 0.3 * dot(from.rise, viewer);
	from.rise *= 0.4;
	from.level = from.viewer;
	if (from.level.UP < 0.0) {
		from.level.UP = 0.0;
		from.level /= max(length(from.level), 1e-4);
	}
	from.up = from.level.UP;
	if (bending.there) from.level = unbent(from.level, bending);
	from.level.UP = 0.0;
#ifdef FIN_EYE
	from.level /= max(length(from.level), 1e-4);
#endif
	from.q = dot(from.level, from.level);
	from.p = dot(from.level, leanTS());
	return from;
}

#define MIN_SEEN 0.1
#if defined(FIN) && !defined(FIN_EYE)
#define MOST_SEEN 2.47 // π²/4: light that an upright Lambertian hair sends back to the lamp, over the mean of all ways around it
#endif

#ifdef EYE
// Terms in the order of the format, with a = level·l, b = leaning·l: q, a, q·b, p·b; q·z, q·b², p, a²; p·a·b, q·p, q·b·z, q·a·b;
// a·z, p·z, q·z², q·p·b.

// Share of a lamp's light for the eye, by 1, s, s². lightTS: not below the horizon
vec3 napTowards(Eye from, vec3 lightTS) {
	float q = from.q, p = from.p, a = dot(from.level, lightTS), b = dot(leanTS(), lightTS), z = lightTS.UP;
	mat4 terms = mat4(vec4(q, a, q * b, p * b), vec4(q * z, q * b * b, p, a * a), vec4(p * a * b, q * p, q * b * z, q * a * b), vec4(a * z, p * z, q * z * z, q * p * b));
	vec3 nap = vec3(1.0 + from.more + dot(from.rise, lightTS), 0.0, 0.0);
	for (int i = 0; i < 4; i++)
		nap += vec3(dot(terms[i], ofFur(eye, 12, i)), dot(terms[i], ofFur(eye, 12, 4 + i)), dot(terms[i], ofFur(eye, 12, 8 + i)));
	return nap;
}

// Excess of light beside the eye. up: height of the eye over the horizon
float surgeFrom(float up) {
#ifdef FIN
	return 0.0; // tips at the outline stand in no shadow
#else
	return furSurge.x + furSurge.y * (1.0 - up * up);
#endif
}

// Factor of the light of a lamp beside the eye. way: unit vector to the lamp through the pelt, the frame's axes
float surgeTowards(Eye from, vec3 way) {
	vec3 apart = (way - from.viewer) / furSurge.z;
	return 1.0 + surgeFrom(from.up) / (1.0 + dot(apart, apart));
}

// κ·v_z² of pelt/lean.py: strength of light along hairs that lean. radius: β of the body
float leanSeen(Eye from, float radius) {
	return clamp(12.0 * length(lean) / radius - 0.8, 0.0, 1.0) * from.up * from.up;
}

// Factor of a lamp's light along hairs that lean. radius: β towards it; lightTS: not below the horizon; beside: cosine between
// lamp and eye
float alongLean(Eye from, float radius, vec3 lightTS, float beside) {
	float b = dot(leanTS(), lightTS);
	return 1.0 + leanSeen(from, radius) * b * b * (0.28 + 0.16 * b) * (1.0 - abs(beside));
}

// Share of a lamp's light for the eye at a height s, without the surge.
float napAt(Arrival at, float s) {
	s /= furTrim;
	float nap = at.nap.x + s * (at.nap.y + s * at.nap.z);
#if defined(FIN) && !defined(FIN_EYE)
	// The law is found for shells, of which the highest hardly count in what is seen.
	nap = min(nap, MOST_SEEN);
#endif
	return max(nap, MIN_SEEN);
}
#else
vec3 napTowards(Eye from, vec3 lightTS) {
	return vec3(0.0);
}

float surgeTowards(Eye from, vec3 way) {
	return 1.0;
}

float alongLean(Eye from, float radius, vec3 lightTS, float beside) {
	return 1.0;
}

float napAt(Arrival at, float s) {
	return 1.0;
}
#endif
