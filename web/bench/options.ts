/** Options of the bench in the page's address: `?run=1&rounds=3&size=640x360&parts=results`. */

import { type BenchOptions, DEFAULTS, PARTS, QUICK } from '../measure/bench/plan.ts';
import { METHODS } from '../measure/bench/results.ts';

/** Parameter that was not understood, as written in the address, and the expected form. */
export interface Problem {
	given: string;
	expected: 'rounds' | 'size' | 'post' | readonly string[];
}

export interface BenchAddress {
	options: BenchOptions;
	/** Whether defaults are those of a first look. */
	quick: boolean;
	/** Whether to start at once. */
	run: boolean;
	/** Path on this host to post the figures to. */
	post: string | undefined;
	/** Parameters that were not understood, replaced by defaults. */
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

	/** Entries of a list named in the address, in the list's order. */
	function some<T extends string, Otherwise>(
		name: string,
		all: readonly T[],
		otherwise: Otherwise,
	): readonly T[] | Otherwise {
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

/** Whether a path stays on this host in any browser; some drop tabs and turn backslashes. */
function isHere(path: string): boolean {
	const host = 'http://here.invalid';
	return path.startsWith('/') && URL.canParse(path, host) && new URL(path, host).origin === host;
}
