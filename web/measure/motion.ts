/** Cost of motion for one baked model, printed by `npm run motion`. */

import { WebGLRenderer } from 'three';
import { type Fur, FurMotion } from '../fur/index.ts';
import type { MotionCost, MotionFigures } from './figures.ts';
import { median, perRound, ratio, thereAndBack } from './statistics.ts';
import { loadFur, Studio } from './studio.ts';

const SECONDS = 1 / 60; // simulated length of a frame
const SETTLING = 60; // frames until hairs follow the wind and programs are compiled
const GUSTY = { strength: 0.5, gusts: 0.7 };

/** Modes compared: fur without motion, asleep, and in the wind. */
const MODES = ['without', 'asleep', 'cpu', 'gpu'] as const;

type Mode = (typeof MODES)[number];

/** Quantile of the values. @param share of all values */
function quantile(values: readonly number[], share: number): number {
	const sorted = values.toSorted((a, b) => a - b);
	return sorted[Math.min(Math.floor(share * sorted.length), sorted.length - 1)] ?? Number.NaN;
}

/** Motion of each mode that has one, with those in the wind under way. */
function makeMotions(fur: Fur, renderer: WebGLRenderer): Partial<Record<Mode, FurMotion>> {
	// Without a renderer the CPU does all; a clock that makes the CPU seem slow moves it to the GPU.
	let [late, asked] = [0, 0];
	const clock = () => {
		late += 1000 / ++asked;
		return late;
	};
	const [asleep, cpu, gpu] = [new FurMotion(fur), new FurMotion(fur), new FurMotion(fur, { renderer, clock })];
	for (const motion of [cpu, gpu]) {
		Object.assign(motion.wind, GUSTY);
		fur.motion = motion;
		for (let i = 0; i < SETTLING; i++) fur.update(SECONDS);
	}
	return { asleep, cpu, gpu };
}

/**
 * @param url of an asset's model.gltf
 * @param rounds rounds of a turn there and a turn back for each mode
 * @param frames frames of a turn, after one that does not count
 */
export async function measureMotion(
	url: string,
	{ width = 640, height = 400, shells = 'auto' as number | 'auto', rounds = 8, frames = 4 } = {},
): Promise<MotionFigures> {
	const fur = await loadFur(url);
	const renderer = new WebGLRenderer({ antialias: false });
	const studio = new Studio(renderer, fur, width, height);
	studio.showFur(shells, fur.fins !== undefined);
	const motions = makeMotions(fur, renderer);
	const script: Record<Mode, number[]> = { without: [], asleep: [], cpu: [], gpu: [] };
	const turns: Record<Mode, number[]> = { without: [], asleep: [], cpu: [], gpu: [] };
	const frame = (mode: Mode): [script: number, whole: number] => {
		const start = performance.now();
		fur.motion = motions[mode];
		fur.update(SECONDS);
		const moved = performance.now() - start;
		return [moved, moved + studio.time()];
	};
	for (let round = -1; round < rounds; round++) {
		for (const mode of thereAndBack(MODES)) {
			frame(mode);
			const times = Array.from({ length: frames }, () => frame(mode));
			// Skip the first round, which compiles.
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
