// Local light on the hairs, part per fragment: see local.vert.glsl.

#if NUM_DIR_LIGHTS > 4
#define LAMPS 4
#else
#define LAMPS NUM_DIR_LIGHTS
#endif

#ifdef MEAN_STRAND
flat in vec3 vStrand;
#else
uniform sampler2DArray directionPlane; // mean unit vector along the texel's hairs, ½ + ½·(T, B, N)
#endif
in vec3 vSoft;
#if LAMPS > 0
in vec4 vLamp[LAMPS];
#endif
#ifdef HIGHLIGHT
in vec3 vViewer;
uniform float highlight;
uniform float sharpness; // exponent of the highlight
#endif

vec3 strandTS(vec3 at) {
#ifdef MEAN_STRAND
	return vStrand;
#else
	return normalize(texture(directionPlane, at).rgb * 2.0 - 1.0);
#endif
}

// 4π·radiance of hairs of this colour. through: share of the first lamp's light that other hairs let through.
vec3 localRadiance(vec3 colour, vec3 strand, float through) {
	vec3 light = vSoft, shine = vec3(0.0);
#if LAMPS > 0
	for (int i = 0; i < LAMPS; i++) {
		vec3 lamp = directionalLights[i].color * (vLamp[i].w * (i == 0 ? through : 1.0));
		light += lamp * kajiyaKayDiffuse(strand, vLamp[i].xyz);
#ifdef HIGHLIGHT
		shine += lamp * kajiyaKaySpecular(strand, normalize(vLamp[i].xyz), normalize(vViewer), sharpness);
#endif
	}
#endif
#ifdef HIGHLIGHT
	return colour * light + highlight * shine;
#else
	return colour * light;
#endif
}
