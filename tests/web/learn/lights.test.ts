import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { angleBetween, elevationOf, nearest, neighbour, toTile, toWorld } from '../../../web/learn/data/lights.ts';
import { decodeLayer, type LessonRecord } from '../../../web/learn/data/measurements.ts';

const file = (name: string) => readFileSync(new URL(`../../../public/lesson/${name}`, import.meta.url));
const record: LessonRecord = JSON.parse(file('lesson.json').toString());
const lamps = record.lights.slice(0, record.fitted + record.held_out);

describe('the lamps', () => {
	it('stand right, away and above where the world has them', () => {
		expect(toTile({ x: 1, y: 2, z: 3 })).toEqual([1, -3, 2]);
		expect(toWorld(toTile({ x: 1, y: 2, z: 3 }))).toEqual([1, 2, 3]);
		expect(elevationOf([0, 0, 1])).toBeCloseTo(90);
		expect(angleBetween([0, 0, 1], [1, 0, 0])).toBeCloseTo(90);
		lamps.forEach((lamp, i) => {
			expect(nearest(lamps, lamp)).toBe(i);
		});
	});

	it('are all reached by arrow keys, from low or high ones', () => {
		const keys = [
			[1, 0],
			[-1, 0],
			[0, 1],
			[0, -1],
		] as const;
		for (const start of [0, 40, 63, 95]) {
			const reached = new Set([start]);
			for (const from of reached)
				for (const [right, up] of keys) {
					const next = neighbour(lamps, from, right, up);
					if (next === undefined) continue;
					reached.add(next);
					const along = (lamps[next]?.[0] ?? 0) * right + (lamps[next]?.[1] ?? 0) * up;
					expect(along).toBeGreaterThan((lamps[from]?.[0] ?? 0) * right + (lamps[from]?.[1] ?? 0) * up);
				}
			expect(reached.size).toBe(lamps.length);
		}
	});
});

describe('a layer', () => {
	it('of another make is refused with both sizes', () => {
		const planes = record.planes.map(file);
		const [first, second] = record.samples;
		const other = () => decodeLayer(record, 0, file(second?.file ?? ''), planes);
		expect(other).toThrow(`${first?.file}: got ${second?.texels} × 113, expected ${first?.texels} × 113`);
	});
});
