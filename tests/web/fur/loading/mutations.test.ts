import { afterEach, expect, it, vi } from 'vitest';
import { golden, load, serve } from './assets.ts';
import { dice, mutate } from './mutations.ts';

afterEach(() => {
	vi.restoreAllMocks();
	vi.unstubAllGlobals();
});

/** Sentences of ours: place or file, then what is wrong. */
const OWN = /^((glTF|FUR_ptm_shells)[^\s:]*: |[^:]+: (got |could not be loaded \(|not a readable PNG \())[^\n]+$/;

it.each(['eigen-3', 'ptm-6'])(
	'150 changes of %s: each loads, or is refused in our own sentence',
	async (name) => {
		vi.spyOn(console, 'warn').mockReturnValue();
		const { json, files } = golden(name);
		serve(files);
		const roll = dice(7);
		let refused = 0;
		for (let i = 0; i < 150; i++) {
			const changed = structuredClone(json);
			const what = `${i}: ${mutate(changed, roll)}`;
			const error: Error | undefined = await load(changed, { newer() {} }).then(
				() => undefined,
				(error) => error,
			);
			if (!error) continue;
			refused++;
			expect(error.message, what).toMatch(OWN);
			expect(error.constructor, what).toBe(Error);
		}
		expect(refused).toBeGreaterThan(75);
	},
	60_000,
);
