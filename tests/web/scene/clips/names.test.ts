import { expect, it } from 'vitest';
import { clipNames } from '../../../../web/scene/clips/names.ts';

it.each([
	[
		['Walk', 'Run'],
		['Walk', 'Run'],
	],
	[
		['Walk', 'Walk', 'Walk'],
		['Walk', 'Walk 2', 'Walk 3'],
	],
	[
		['Walk 2', 'Walk', 'Walk'],
		['Walk 2', 'Walk', 'Walk 3'],
	],
	[
		['', 'Run', ''],
		['clip 1', 'Run', 'clip 3'],
	],
])('each clip has a name of its own: %j', (given, names) => {
	expect(clipNames(given.map((name) => ({ name })))).toEqual(names);
});
