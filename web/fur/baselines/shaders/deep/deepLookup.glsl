// Transmittance of the lamp's light to a hair, looked up from the maps of deepOpacity.glsl.

uniform highp sampler2D lightOpacity; // per layer
uniform float extinction; // κ: below 1, since light that hairs scatter forwards is not lost

// mapped: XY of the maps, Z = depth in them, 0..1.
float deepTransmittance(vec3 mapped) {
	vec2 depths = texture(lightDepths, mapped.xy).xy;
	vec4 opacity = texture(lightOpacity, mapped.xy);
	vec2 below = (mapped.z - depths) * mapDepth;
	vec4 passed = clamp((below.x - LAYER_FROM) / LAYER_DEPTH, 0.0, 1.0);
	float behind = clamp(2.0 * below.y - 0.2, 0.0, 1.0); // shadow of the skin, over half a length of the fur
	return exp(-extinction * opacityUnit * dot(opacity, passed)) * (1.0 - behind);
}
