/** Gain and cost of fins for one baked model, printed by `npm run fins`. */

import { WebGLRenderer } from 'three';
import type { Coverage, FinCost, FinFigures, FinView } from './figures.ts';
import { median } from './statistics.ts';
import { loadFur, Studio } from './studio.ts';

const IDEAL = 64; // shells that show the outline without fins
const FEW = 16; // shells that need fins
const VIEWS = [
	{ name: 'front', azimuth: 0, polar: Math.PI / 2 },
	{ name: 'side', azimuth: Math.PI / 2, polar: Math.PI / 2 },
	{ name: 'above', azimuth: -Math.PI / 4, polar: Math.PI / 3 },
] as const;

/** @returns whether each pixel, premultiplied rgba, is at least half covered */
const covered = (rgba: Float32Array) =>
	Array.from({ length: rgba.length / 4 }, (_, i) => (rgba[i * 4 + 3] ?? 0) >= 0.5);

/** Coverage of the wanted pixels by two pictures. */
function coverage(wanted: boolean[], without: Float32Array, fins: Float32Array): Coverage {
	const count = (mask: boolean[]) => wanted.filter((want, i) => want && mask[i]).length;
	return { pixels: count(wanted), without: count(covered(without)), fins: count(covered(fins)) };
}

/** Whether a pixel of the mask lies within `radius` pixels of pixel `i`. */
function near(mask: boolean[], width: number, i: number, radius: number): boolean {
	const [x, y, reach] = [i % width, Math.floor(i / width), Math.floor(radius)];
	for (let dy = -reach; dy <= reach; dy++) {
		const span = Math.floor(Math.sqrt(radius * radius - dy * dy));
		const row = (y + dy) * width;
		for (let at = Math.max(x - span, 0); at <= Math.min(x + span, width - 1); at++) if (mask[row + at]) return true;
	}
	return false;
}

function view(studio: Studio, name: string, width: number, length: number): FinView {
	const draw = (shells: number, fins: boolean) => {
		studio.showFur(shells, fins);
		return studio.draw();
	};
	const skin = draw(0, false);
	const bare = covered(skin);
	const all = covered(draw(IDEAL, false));
	const [without, fins] = [draw(FEW, false), draw(FEW, true)];
	const alone = draw(0, true);
	const changed = [...all.keys()].filter((i) =>
		[0, 1, 2, 3].some((c) => Math.abs((alone[i * 4 + c] ?? 0) - (skin[i * 4 + c] ?? 0)) > 1 / 255),
	);
	return {
		name,
		beside: coverage(
			all.map((ideal, i) => ideal && !bare[i]),
			without,
			fins,
		),
		all: coverage(all, without, fins),
		extra: coverage(
			all.map((ideal) => !ideal),
			without,
			fins,
		),
		finPixels: changed.length,
		outside: changed.filter((i) => !near(all, width, i, length)).length,
	};
}

/** Cost of fins: frames without, with, with, without, each round from the next side. */
function cost(studio: Studio, shells: number, rounds: number): FinCost {
	const times: [without: number, fins: number][] = [];
	const frame = (fins: boolean) => {
		studio.showFur(shells, fins);
		return studio.time();
	};
	for (const fins of [true, false]) frame(fins);
	for (let round = 0; round < rounds; round++) {
		const { azimuth, polar } = VIEWS[round % VIEWS.length] ?? VIEWS[0];
		studio.look(azimuth, polar);
		const [a, b, c, d] = [frame(false), frame(true), frame(true), frame(false)];
		times.push([a, b], [d, c]);
	}
	const ratios = Array.from({ length: rounds }, (_, round) => {
		const [first, second] = times.slice(2 * round) as [[number, number], [number, number]];
		return (first[1] + second[1]) / (first[0] + second[0]);
	});
	return {
		shells,
		without: median(times.map(([without]) => without)),
		fins: median(times.map(([, fins]) => fins)),
		ratio: median(ratios),
	};
}

/**
 * @param url of an asset's model.gltf
 * @param counts numbers of shells to measure the cost at
 * @param rounds rounds of four frames for each number
 */
export async function measureFins(
	url: string,
	{ width = 640, height = 400, counts = [16, 48] as readonly number[], rounds = 15 } = {},
): Promise<FinFigures> {
	const fur = await loadFur(url);
	if (!fur?.fins) throw new Error('model.gltf: got no fins, expected a model that was baked with them');
	const renderer = new WebGLRenderer({ antialias: false });
	const studio = new Studio(renderer, fur, width, height);
	const length = fur.asset.length * studio.scale;
	const views = VIEWS.map(({ name, azimuth, polar }) => {
		studio.look(azimuth, polar);
		return view(studio, name, width, length);
	});
	const costs = counts.map((shells) => cost(studio, shells, rounds));
	studio.dispose();
	renderer.dispose();
	return { width, height, length, views, costs };
}
