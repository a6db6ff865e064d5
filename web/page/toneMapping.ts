/**
 * Tone mapping of the pages: what is picked is what is seen. Colours below a shoulder stay as they are; above it the largest
 * channel is compressed towards 1 and the others with it, so that hue and saturation stay. Light far beyond white pales.
 *
 * Curves made for photographs turn lit orange fur into peach, and darken what is nearly black.
 */

import { CustomToneMapping, ShaderChunk, type WebGLRenderer } from 'three';

/** Largest channel, linear, up to which nothing changes. */
export const SHOULDER = 0.6;
/** Paling per unit of light that the curve has taken away. */
export const PALING = 0.03;

/** Three's, which changes nothing; the built page has it without spaces. */
const NONE = /vec3 CustomToneMapping\([^}]*\}/;
const CURVE = /* glsl */ `
vec3 CustomToneMapping(vec3 color) {
	color *= toneMappingExposure;
	const float shoulder = ${SHOULDER};
	float peak = max(color.r, max(color.g, color.b));
	if (peak <= shoulder) return color;
	float shown = 1.0 - (1.0 - shoulder) * (1.0 - shoulder) / (peak + 1.0 - 2.0 * shoulder);
	float kept = 1.0 / (1.0 + ${PALING} * (peak - shown));
	return mix(vec3(shown), color * (shown / peak), kept);
}`;

/** Use the pages' tone mapping. Call it before the renderer compiles anything. */
export function setToneMapping(renderer: WebGLRenderer): void {
	ShaderChunk.tonemapping_pars_fragment = ShaderChunk.tonemapping_pars_fragment.replace(NONE, CURVE);
	renderer.toneMapping = CustomToneMapping;
}
