// Displacement within the last sub-step.

precision highp float;
precision highp sampler2D;

uniform sampler2D before;
uniform sampler2D after;
uniform float share; // elapsed share of the sub-step

out vec4 swing;

void main() {
	ivec2 at = ivec2(gl_FragCoord.xy);
	swing = vec4(mix(texelFetch(before, at, 0).xyz, texelFetch(after, at, 0).xyz, share), 0.0);
}
