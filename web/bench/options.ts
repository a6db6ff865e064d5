/** What is measured, as the page's address says it: `?run=1&rounds=3&size=640x360&parts=results`. */

import { type BenchOptions, DEFAULTS, PARTS, QUICK } from '../measure/plan.ts';
import { METHODS } from '../measure/results.ts';

export interface BenchAddress {
	options: BenchOptions;
	/** Whether they are those of a first look, but for what else the address says. */
	quick: boolean;
	/** Whether to begin by itself. */
	run: boolean;
	/** Path on this very site that the figures are sent to. */
	post: string | undefined;
	/** What was not understood, a line each; the default stands there. */
	problems: string[];
}

/** @param search `?...` of the page's address */
export function parseOptions(search: string): BenchAddress {
	const query = new URLSearchParams(search);
	const problems: string[] = [];
	const quick = query.get('quick') === '1';
	const options = { ...(quick ? QUICK : DEFAULTS) };

	const rounds = query.get('rounds');
	if (rounds !== null) {
		if (/^[1-9]\d?$/.test(rounds)) options.rounds = Number(rounds);
		else problems.push(`rounds=${rounds}: expected 1 to 99`);
	}
	const size = query.get('size');
	if (size !== null) {
		const [width = 0, height = 0] = (/^(\d{1,4})x(\d{1,4})$/.exec(size) ?? []).slice(1).map(Number);
		if (width >= 16 && height >= 16) Object.assign(options, { width, height });
		else problems.push(`size=${size}: expected width and height, 16 to 9999 pixels, as in 1280x720`);
	}
	options.parts = some('parts', PARTS, options.parts);
	options.methods = some('methods', METHODS, options.methods);
	options.triangles = some('triangles', DEFAULTS.triangles.map(String), options.triangles.map(String)).map(Number);
	const post = query.get('post');
	if (post !== null && !/^\/(?!\/)/.test(post)) problems.push(`post=${post}: expected a path on this site`);
	return {
		options,
		quick,
		run: query.get('run') === '1',
		post: post !== null && /^\/(?!\/)/.test(post) ? post : undefined,
		problems,
	};

	/** Those of a list that the address names, in the list's own order. */
	function some<T extends string>(name: string, all: readonly T[], otherwise: readonly T[]): readonly T[] {
		const named = query.get(name)?.split(',');
		if (!named) return otherwise;
		const odd = named.filter((item) => !all.includes(item as T));
		const found = all.filter((item) => named.includes(item));
		if (odd.length || !found.length) {
			problems.push(`${name}=${query.get(name)}: expected some of ${all.join(', ')}`);
			return otherwise;
		}
		return found;
	}
}
