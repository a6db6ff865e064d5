import { describe, expect, it } from 'vitest';
import { Stopwatch } from '../../../web/measure/stopwatch.ts';

describe('a turn', () => {
	it.each([
		[500, 1],
		[30, 1],
		[3, 10],
		[0.01, 64],
		[0, 64],
	])('of frames of %d ms is %d of them', (milliseconds, frames) => {
		expect(Stopwatch.framesFor(milliseconds)).toBe(frames);
	});
});
