// Light that comes from behind through thin skin, as through ears. The shadow map of a directional lamp tells how thick the body
// is (Dachsbacher and Stamminger: Translucent Shadow Maps, 2003), its curvature whether it is a leaf or a limb, which has bones.

#if defined(GLOW) && defined(USE_SHADOWMAP) && NUM_DIR_LIGHT_SHADOWS > 0
#define GLOWING

uniform float glow; // thickness of skin from which on it is dark, world units

#define GLOW_TAPS 6
#define HULL 0.75 // height of the shadows' hull, lengths of the hair
const vec3 SKIN = vec3(0.46, 0.15, 0.075); // share of the light that thin skin lets through

// Share of a lamp's light on the other side that comes through.
float glowThrough(ShadowMap map, mat4 matrix, float bias, FurPoint point, vec3 lightVS) {
	float facing = -dot(lightVS, point.frameVS[UPRIGHT]);
	// Long hairs on either side take what skin lets through.
	float bare = 1.0 - smoothstep(0.12, 0.35, point.reach / glow);
	if (facing <= 0.0 || bare <= 0.0 || !receiveShadow) return 0.0;
	// Largest convex curvature: a ball's is twice the share facing away over the way through it, a leaf's is small.
	vec3 bend = point.curvature / max(point.reach, 1e-9);
	float round = max(0.5 * (bend.x + bend.y) + length(vec2(0.5 * (bend.x - bend.y), bend.z)), 0.0);
	vec3 light = lightVS * mat3(viewMatrix);
	vec3 root = (point.pointVS - point.reach * point.s * point.frameVS[UPRIGHT] - viewMatrix[3].xyz) * mat3(viewMatrix);
	float hull = HULL * point.reach / max(facing, 0.3), sum = 0.0;
	// From the thickest on: most of a body is thicker, and done after one.
	for (int i = GLOW_TAPS - 1; i >= 0; i--) {
		float way = glow * (float(i) + 0.5) / float(GLOW_TAPS);
		vec4 place = matrix * vec4(root + (hull + way) * light, 1.0);
		float lit = shadowTap(map, place.xyz / place.w + vec3(0.0, 0.0, bias));
		if (lit <= 0.0) break;
		float bulge = round * way / facing;
		sum += lit / (1.0 + bulge * bulge * bulge);
	}
	sum /= float(GLOW_TAPS);
	return bare * facing * sum * sum;
}
#endif
