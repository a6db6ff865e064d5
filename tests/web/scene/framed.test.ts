/** Room around a body in its first picture. */

import { expect, it } from 'vitest';
import { framedRadius } from '../../../web/scene/framed.ts';

it.each([
	[1, 0, 1.2],
	[1, 0.1, 1.2],
	[1, 0.5, 1.5],
	[40, 100, 140],
])('of radius %f and fur of %f is %f', (radius, length, framed) => {
	expect(framedRadius(radius, length)).toBeCloseTo(framed, 12);
});
