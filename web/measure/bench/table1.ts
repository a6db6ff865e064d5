/** Table 1 of the article, measured here: speed of the PTM over layered shadow maps. */

import { median, ratio } from '../statistics.ts';
import { Comparison } from './Comparison.ts';
import { DEFAULTS, QUICK, SHELLS, TORI } from './plan.ts';
import type { Table1Row } from './results.ts';
import { makeSubject, type Subject } from './subjects.ts';
import { loadBenchModels } from './tori.ts';

export interface Table1Options {
	/** Whether to use fewer rounds and a quarter of the pixels. */
	quick?: boolean;
	rounds?: number;
	/** Pixels. */
	width?: number;
	height?: number;
	/** Numbers of triangles, out of `TORI`. */
	triangles?: readonly number[];
}

const METHODS = ['shadow-layers', 'ptm'] as const;

/**
 * Compares the two methods of the article's table under one moving lamp, in turn on each of its tori.
 *
 * @param progress called with the share done, 0..1
 */
export async function measureTable1(
	{ quick = false, ...asked }: Table1Options,
	signal: AbortSignal,
	progress: (share: number) => void,
): Promise<Table1Row[]> {
	const { rounds, width, height, triangles } = { ...(quick ? QUICK : DEFAULTS), ...asked };
	const models = await loadBenchModels(triangles, METHODS);
	let comparison: Comparison | undefined;
	const groups: Subject[][] = [];
	try {
		comparison = new Comparison();
		const { renderer } = comparison;
		for (const size of TORI.filter((torus) => triangles.includes(torus.triangles))) {
			const torus = models.tori.get(size.triangles);
			if (!torus) throw new Error(`torus-${size.triangles}: it was not loaded`);
			const row = { light: 'moving', fins: false, triangles: size.triangles, shells: SHELLS, width, height } as const;
			groups.push(METHODS.map((method) => makeSubject(renderer, { ...row, method }, torus, models)));
		}
		const times = await comparison.timeInTurn(groups, rounds, signal, (done, total) => progress(done / total));
		return groups.map(([layers, ptm]) => {
			const [slow = [], fast = []] = [layers, ptm].map((subject) => subject && times.get(subject));
			return {
				triangles: ptm?.row.triangles ?? 0,
				layered: { fps: 1000 / median(slow) },
				ptm: { fps: 1000 / median(fast) },
				ratio: ratio(slow, fast),
			};
		});
	} finally {
		for (const subject of groups.flat()) subject.dispose();
		comparison?.dispose();
		models.dispose();
	}
}
