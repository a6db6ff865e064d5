/** Table 1 of the article, measured here: how much faster the PTM is than layered shadow maps. */

import { Arena } from './arena.ts';
import { DEFAULTS, QUICK, SHELLS, TORI } from './plan.ts';
import type { Table1Row } from './results.ts';
import { makeRival, type Rival } from './rivals.ts';
import { median, ratio } from './statistics.ts';
import { loadWardrobe } from './tori.ts';

export interface Table1Options {
	/** Fewer rounds, a quarter of the pixels. */
	quick?: boolean;
	rounds?: number;
	/** Pixels. */
	width?: number;
	height?: number;
	/** Some of those of `TORI`. */
	triangles?: readonly number[];
}

const METHODS = ['shadow-layers', 'ptm'] as const;

/**
 * The two methods of the article's table under one lamp that moves every frame, drawn in turn on each of its tori.
 *
 * @param progress is told the share that is done, 0..1
 */
export async function measureTable1(
	{ quick = false, ...asked }: Table1Options,
	signal: AbortSignal,
	progress: (share: number) => void,
): Promise<Table1Row[]> {
	const { rounds, width, height, triangles } = { ...(quick ? QUICK : DEFAULTS), ...asked };
	const wardrobe = await loadWardrobe(triangles, METHODS);
	let arena: Arena | undefined;
	const groups: Rival[][] = [];
	try {
		arena = new Arena();
		for (const size of TORI.filter((torus) => triangles.includes(torus.triangles))) {
			const torus = wardrobe.tori.get(size.triangles);
			if (!torus) throw new Error(`torus-${size.triangles}: it was not loaded`);
			const row = { light: 'moving', fins: false, triangles: size.triangles, shells: SHELLS, width, height } as const;
			groups.push(METHODS.map((method) => makeRival({ ...row, method }, torus, wardrobe)));
		}
		const times = await arena.contest(groups, rounds, signal, (done, total) => progress(done / total));
		return groups.map(([layers, ptm]) => {
			const [slow = [], fast = []] = [layers, ptm].map((rival) => rival && times.get(rival));
			return {
				triangles: ptm?.row.triangles ?? 0,
				layered: { fps: 1000 / median(slow) },
				ptm: { fps: 1000 / median(fast) },
				ratio: ratio(slow, fast),
			};
		});
	} finally {
		for (const rival of groups.flat()) rival.dispose();
		arena?.dispose();
		wardrobe.dispose();
	}
}
