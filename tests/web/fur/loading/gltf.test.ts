import { readdirSync, readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { checkGltf } from '../../../../web/fur/format/gltf.ts';
import { golden, type Json } from './assets.ts';

const root = new URL('../../../../', import.meta.url);

it.each(['public/models', 'tests/golden'])('takes every asset of %s', (folder) => {
	const paths = readdirSync(new URL(folder, root), { recursive: true, encoding: 'utf8' });
	const assets = paths.filter((path) => path.endsWith('model.gltf'));
	expect(assets.length).toBeGreaterThan(3);
	for (const path of assets) {
		const json = JSON.parse(readFileSync(new URL(`${folder}/${path}`, root), 'utf8'));
		expect(() => checkGltf(json), path).not.toThrow();
	}
});

it.each<[string, (json: Json) => void, string]>([
	['a node', (json) => json.scenes[0].nodes.push(9), 'scenes/0/nodes/1: 9 is greater than or equal to 3.'],
	[
		'an image without a place',
		(json) => delete json.images[1].uri,
		'images/1: Instance does not have required property "bufferView".',
	],
	[
		'a buffer view beyond its buffer',
		(json) => Object.assign(json.bufferViews[0], { byteOffset: 1e6 }),
		'bufferViews/0: got 1002312, expected at most 101792 in buffer 0',
	],
	[
		'an accessor beyond its view',
		(json) => Object.assign(json.accessors[2], { count: 1537 }),
		'accessors/2: got 3074, expected at most 3072 bytes in buffer view 2',
	],
	[
		'an accessor beyond its view, by the stride',
		(json) => Object.assign(json.accessors[0], { count: 290 }),
		'accessors/0: got 2320, expected at most 2312 bytes in buffer view 0',
	],
	[
		'elements longer than their stride',
		(json) => Object.assign(json.accessors[0], { type: 'VEC4', componentType: 5126, min: undefined, max: undefined }),
		'accessors/0: got 16, expected at most 8 bytes by its stride',
	],
	[
		'an odd offset',
		(json) => Object.assign(json.accessors[2], { byteOffset: 1, count: 9 }),
		'accessors/2: got an offset of 1 and a stride of 2 bytes, expected multiples of 2',
	],
	[
		'sparse values beyond their view',
		(json) => {
			const indices = { bufferView: 2, componentType: 5123 };
			json.accessors[3].sparse = { count: 200, indices, values: { bufferView: 2, byteOffset: 2000 } };
		},
		'accessors/3/sparse/values: got 3200, expected at most 3072 bytes in buffer view 2',
	],
	[
		'gigabytes out of nothing',
		(json) => json.accessors.push({ componentType: 5126, count: 1e9, type: 'VEC3' }),
		'accessors: got 3000000000, expected at most 16777216 numbers without a buffer view',
	],
	[
		'a node that is its own grandchild',
		(json) => {
			json.nodes[0].children = [1];
			json.nodes[1].children = [0];
		},
		'nodes: got a circle of children, expected trees',
	],
	[
		'a node with two parents',
		(json) => {
			json.nodes[0].children = [2];
			json.nodes[1].children = [2];
		},
		'nodes/2: got two parents, expected one',
	],
])('refuses %s in one sentence', (_, breakIt, sentence) => {
	const { json } = golden();
	breakIt(json);
	expect(() => checkGltf(JSON.parse(JSON.stringify(json)))).toThrow(new Error(`glTF/${sentence}`));
});
