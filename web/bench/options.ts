/** What is measured, as the page's address says it: `?run=1&rounds=3&size=640x360&parts=results`. */

import { type BenchOptions, DEFAULTS, PARTS, QUICK } from '../measure/plan.ts';
import { METHODS } from '../measure/results.ts';

/** A parameter that was not understood, as it stands in the address, and what was expected there. */
export interface Problem {
	given: string;
	expected: 'rounds' | 'size' | 'post' | readonly string[];
}

export interface BenchAddress {
	options: BenchOptions;
	/** Whether they are those of a first look, but for what else the address says. */
	quick: boolean;
	/** Whether to begin by itself. */
	run: boolean;
	/** Path on this very site that the figures are sent to. */
	post: string | undefined;
	/** What was not understood; the default stands there. */
	problems: Problem[];
}

/** @param search `?...` of the page's address */
export function parseOptions(search: string): BenchAddress {
	const query = new URLSearchParams(search);
	const problems: Problem[] = [];
	const quick = query.get('quick') === '1';
	const options = { ...(quick ? QUICK : DEFAULTS) };

	const rounds = query.get('rounds');
	if (rounds !== null) {
		if (/^[1-9]\d?$/.test(rounds)) options.rounds = Number(rounds);
		else problems.push({ given: `rounds=${rounds}`, expected: 'rounds' });
	}
	const size = query.get('size');
	if (size !== null) {
		const [width = 0, height = 0] = (/^(\d{1,4})x(\d{1,4})$/.exec(size) ?? []).slice(1).map(Number);
		if (width >= 16 && height >= 16) Object.assign(options, { width, height });
		else problems.push({ given: `size=${size}`, expected: 'size' });
	}
	options.parts = some('parts', PARTS, options.parts);
	options.methods = some('methods', METHODS, options.methods);
	options.triangles = some('triangles', DEFAULTS.triangles.map(String), options.triangles.map(String)).map(Number);
	const post = query.get('post');
	const posts = post !== null && isHere(post);
	if (post !== null && !posts) problems.push({ given: `post=${post}`, expected: 'post' });
	return {
		options,
		quick,
		run: query.get('run') === '1',
		post: posts ? post : undefined,
		problems,
	};

	/** Those of a list that the address names, in the list's own order. */
	function some<T extends string>(name: string, all: readonly T[], otherwise: readonly T[]): readonly T[] {
		const named = query.get(name)?.split(',');
		if (!named) return otherwise;
		const odd = named.filter((item) => !all.includes(item as T));
		const found = all.filter((item) => named.includes(item));
		if (odd.length || !found.length) {
			problems.push({ given: `${name}=${query.get(name)}`, expected: all });
			return otherwise;
		}
		return found;
	}
}

/** Whether a path is one of this very host, however browsers read it: of some they leave out tabs, and turn backslashes. */
function isHere(path: string): boolean {
	const host = 'http://here.invalid';
	return path.startsWith('/') && URL.canParse(path, host) && new URL(path, host).origin === host;
}
