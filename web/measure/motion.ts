/** What motion costs a frame, for one baked model; `npm run motion` prints it. */

import { WebGLRenderer } from 'three';
import { FurMotion } from '../fur/index.ts';
import type { MotionCost, MotionFigures } from './figures.ts';
import { median, perRound, ratio, thereAndBack } from './statistics.ts';
import { loadFur, Studio } from './studio.ts';

const SECONDS = 1 / 60; // of a frame, whatever it takes to draw
const SETTLING = 60; // frames until wind has the hair, and springs have been compiled
const GUSTY = { strength: 0.5, gusts: 0.7 };

/** What takes turns: fur that knows nothing of motion, fur whose springs sleep, and fur in the wind. */
const MODES = ['without', 'asleep', 'cpu', 'gpu'] as const;

type Mode = (typeof MODES)[number];

/** The value that so many of all don't exceed. @param share of all */
function quantile(values: readonly number[], share: number): number {
	const sorted = values.toSorted((a, b) => a - b);
	return sorted[Math.min(Math.floor(share * sorted.length), sorted.length - 1)] ?? Number.NaN;
}

/**
 * @param url of an asset's model.gltf
 * @param rounds of a turn there and a turn back for each mode
 * @param frames of a turn, after one that does not count
 */
export async function measureMotion(
	url: string,
	{ width = 640, height = 400, shells = 'auto' as number | 'auto', rounds = 8, frames = 4 } = {},
): Promise<MotionFigures> {
	const fur = await loadFur(url);
	const renderer = new WebGLRenderer({ antialias: false });
	const studio = new Studio(renderer, fur, width, height);
	studio.wear(shells, fur.fins !== undefined);
	// The CPU has all of it where there is no renderer, the GPU by a clock that says that the CPU takes longer.
	let [late, asked] = [0, 0];
	const clock = () => {
		late += 1000 / ++asked;
		return late;
	};
	const motions: Partial<Record<Mode, FurMotion>> = {
		asleep: new FurMotion(fur),
		cpu: new FurMotion(fur),
		gpu: new FurMotion(fur, { renderer, clock }),
	};
	for (const mode of ['cpu', 'gpu'] as const) {
		const motion = motions[mode] as FurMotion;
		Object.assign(motion.wind, GUSTY);
		for (let i = 0; i < SETTLING; i++) motion.update(SECONDS);
	}
	const script: Record<Mode, number[]> = { without: [], asleep: [], cpu: [], gpu: [] };
	const turns: Record<Mode, number[]> = { without: [], asleep: [], cpu: [], gpu: [] };
	const frame = (mode: Mode): [script: number, whole: number] => {
		const start = performance.now();
		const motion = motions[mode];
		motion?.update(SECONDS);
		fur.swing = motion?.swing;
		const moved = performance.now() - start;
		return [moved, moved + studio.time()];
	};
	for (let round = -1; round < rounds; round++) {
		for (const mode of thereAndBack(MODES)) {
			frame(mode);
			const times = Array.from({ length: frames }, () => frame(mode));
			// The first round compiles.
			if (round < 0) continue;
			script[mode].push(...times.map(([moved]) => moved));
			turns[mode].push(times.reduce((sum, [, whole]) => sum + whole, 0) / frames);
		}
	}
	const base = perRound(turns.without);
	const costs = MODES.map((mode): MotionCost => {
		const each = perRound(turns[mode]);
		return {
			mode,
			processor: motions[mode]?.processor ?? null,
			frame: median(each),
			ratio: ratio(each, base),
			script: median(script[mode]),
			script95: quantile(script[mode], 0.95),
		};
	});
	const { follicles } = fur;
	const faces = (fur.skin as { geometry?: { index?: { count: number } } }).geometry?.index?.count ?? 0;
	const figures = { width, height, shells: fur.shells.shellCount, faces: faces / 3, follicles: follicles.count, costs };
	for (const motion of Object.values(motions)) motion.dispose();
	studio.dispose();
	renderer.dispose();
	return figures;
}
