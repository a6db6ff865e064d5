/** The pages' tone mapping undone. */

import { PALING, SHOULDER } from '../page/toneMapping.ts';

/** GLSL of the reverse, for pictures that are to be seen as they are; nothing reaches white quite. */
export const UNMAPPED = /* glsl */ `
vec3 unmapped(vec3 shown) {
	const float shoulder = ${SHOULDER};
	float top = min(max(shown.r, max(shown.g, shown.b)), 0.995);
	if (top <= shoulder) return shown;
	float peak = (1.0 - shoulder) * (1.0 - shoulder) / (1.0 - top) - 1.0 + 2.0 * shoulder;
	float kept = 1.0 / (1.0 + ${PALING} * (peak - top));
	return max((shown - (1.0 - kept) * top) / kept, 0.0) * (peak / top);
}`;
