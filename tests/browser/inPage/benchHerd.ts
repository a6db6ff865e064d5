/** Runs inside the page: subjects of the bench with one and with many bodies. Its answers go to `bench.spec.ts`. */

import { Comparison } from '../../../web/measure/bench/Comparison.ts';
import { makeHerd } from '../../../web/measure/bench/herd.ts';
import type { Row } from '../../../web/measure/bench/results.ts';
import { makeSubject } from '../../../web/measure/bench/subjects.ts';
import { loadBenchModels } from '../../../web/measure/bench/tori.ts';

const SIZE = 120;
const row: Row = { method: 'ptm', light: 'moving', fins: false, triangles: 512, shells: 16, width: SIZE, height: SIZE };

/** Share of the picture that is covered, and mean brightness there. */
export interface Covered {
	share: number;
	brightness: number;
}

/** @returns one body by itself, a herd of one, and a herd of four */
export async function coverage(): Promise<[alone: Covered, one: Covered, four: Covered]> {
	const models = await loadBenchModels([512], ['ptm']);
	const torus = models.tori.get(512);
	if (!torus) throw new Error('torus-512: it was not loaded');
	if (torus.fur.fins) torus.fur.fins.visible = false;
	const comparison = new Comparison();
	const subjects = [
		makeSubject(comparison.renderer, row, torus, models),
		makeHerd(row, torus, 1),
		makeHerd(row, torus, 4),
	];
	const found = subjects.map((subject): Covered => {
		const rgba = comparison.picture(subject, SIZE, SIZE);
		let [alpha, green] = [0, 0];
		for (let i = 0; i < rgba.length; i += 4) {
			alpha += rgba[i + 3] ?? 0;
			green += rgba[i + 1] ?? 0;
		}
		return { share: alpha / SIZE ** 2, brightness: green / alpha };
	});
	for (const subject of subjects) subject.dispose();
	comparison.dispose();
	models.dispose();
	return found as [Covered, Covered, Covered];
}
