/** Seeded changes of JSON. */

import type { Json } from './assets.ts';

const JUNK: readonly Json[] = [null, true, -1, 0, 1, 3, 7, 1.5, 255, 65_536, 1e9, 1e300, '', 'x', [], {}, [[]], [null]];

/** Numbers 0 ≤ n < `end` in a row that the seed tells. */
export function dice(seed: number): (end: number) => number {
	let state = seed >>> 0;
	return (end) => {
		state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
		return Math.floor((state / 2 ** 32) * end);
	};
}

/** Places in JSON: objects and arrays with one of their keys. */
function places(json: Json): { holder: Json; key: string }[] {
	if (typeof json !== 'object' || json === null) return [];
	return Object.keys(json).flatMap((key) => [{ holder: json, key }, ...places(json[key])]);
}

/**
 * Changes one place of a glTF: junk, another place's value, a number nearby, nothing, or the same twice; nothing of
 * `asset`, which three reads before any plugin is there. A long list counts about as one place: tables are most of an asset.
 *
 * @returns the change in words
 */
export function mutate(json: Json, roll: (end: number) => number): string {
	const { asset: _, ...changed } = json;
	const all = places(changed).filter(
		({ holder }) => !(Array.isArray(holder) && holder.length > 20 && roll(holder.length)),
	);
	const { holder, key } = all[roll(all.length)] as { holder: Json; key: string };
	const target = holder === changed ? json : holder;
	const before = JSON.stringify(target[key]);
	const kind = roll(8);
	const other = all[roll(all.length)] as { holder: Json; key: string };
	if (kind === 0) Array.isArray(target) ? target.splice(Number(key), 1) : delete target[key];
	else if (kind === 1) target[key] = structuredClone(other.holder[other.key]);
	else if (kind === 2 && Array.isArray(target)) target.push(structuredClone(target[Number(key)]));
	else if (kind < 5 && typeof target[key] === 'number') target[key] += [-1, 1, 2, 100, -0.5][roll(5)] as number;
	else target[key] = structuredClone(JUNK[roll(JUNK.length)]);
	return `${key}: ${before?.slice(0, 60)} → ${JSON.stringify(target[key])?.slice(0, 60)}`;
}
