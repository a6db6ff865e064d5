// Deep opacity maps. C. Yuksel, J. Keyser: Deep Opacity Maps, Computer Graphics Forum 27(2), 2008. Layers of opacity begin
// where the lamp meets the fur, and so follow its shape; four of them are the channels of one texture. A channel holds its
// own layer's opacity, not the sum down to it: interpolated linearly that is the same, for fewer sums.

const vec4 LAYER_FROM = vec4(0.0, 0.2, 0.55, 1.1); // below the fur's outside, lengths of the fur
const vec4 LAYER_DEPTH = vec4(0.2, 0.35, 0.55, 0.9); // the last one extends on

uniform highp sampler2D lightDepths; // X = depth of the fur's outside, Y = depth of the skin, 0..1
uniform float mapDepth; // depth of the light's maps, lengths of the fur
uniform float opacityUnit; // −ln(transmittance) stored as 1

// Contribution of a shell to the layers. depth: along the lamp's ray, 0..1.
vec4 deepLayers(float depth, float opacity) {
	float below = (depth - texelFetch(lightDepths, ivec2(gl_FragCoord.xy), 0).x) * mapDepth;
	vec4 reached = vec4(1.0, step(LAYER_FROM.yzw, vec3(below)));
	return (reached - vec4(reached.yzw, 0.0)) * (opacity / opacityUnit);
}
