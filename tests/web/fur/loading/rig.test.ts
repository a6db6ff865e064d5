/** Broken characters: each is refused in one sentence, before three reads it. */

import { expect, it } from 'vitest';
import { checkRig } from '../../../../web/fur/format/rig.ts';
import { character } from '../../../browser/character.ts';
import type { Json } from '../../../browser/posed.ts';
import { refusal, restoreNetwork, serve } from './assets.ts';

restoreNetwork();

const made = await character('tests/golden/ptm-6-curves');
const { nodes, accessors } = made.json;
const parts = made.json.extensions.FUR_ptm_shells;
const primitive = (json: Json, node: number) => json.meshes[json.nodes[node].mesh].primitives[0];

it('takes a sound one', () => {
	expect(() => checkRig(made.json, parts)).not.toThrow();
});

it.each<[string, (json: Json) => void, string]>([
	['a skin without joints', (json) => json.skins[0].joints.splice(0), 'skins/0: got no joints, expected at least one'],
	[
		'too few inverse matrices',
		(json) => json.skins[0].joints.push(0),
		'skins/0/inverseBindMatrices: got 3 MAT4, expected 4 MAT4 of floats',
	],
	[
		'a skinned mesh without joints',
		(json) => delete primitive(json, 1).attributes.JOINTS_0,
		'nodes/1 with a skin, meshes/1/primitives/0: got no JOINTS_0, expected joints and weights of every vertex',
	],
	[
		'a skinned mesh without weights',
		(json) => delete primitive(json, 0).attributes.WEIGHTS_0,
		'nodes/0 with a skin, meshes/0/primitives/0: got no WEIGHTS_0, expected joints and weights of every vertex',
	],
	[
		'joints of fewer vertices',
		(json) => json.accessors[primitive(json, 1).attributes.JOINTS_0].count--,
		'nodes/1 with a skin, meshes/1/primitives/0/JOINTS_0: got 288 VEC4, expected 289 VEC4',
	],
	[
		'a target of another length',
		(json) => json.accessors[primitive(json, 1).targets[1].POSITION].count--,
		'meshes/1/primitives/0/targets/1/POSITION: got 288 VEC3, expected 289 VEC3',
	],
	[
		'targets of unlike attributes',
		(json) => delete primitive(json, 2).targets[1].POSITION,
		'meshes/2/primitives/0/targets/1: got NORMAL, TANGENT, expected POSITION, and the attributes of the first target',
	],
	[
		'weights for other targets',
		(json) => json.meshes[0].weights.push(1),
		'meshes/0/weights: got 3, expected 2, one per morph target',
	],
	[
		'shells with fewer targets than the body',
		(json) => {
			primitive(json, 1).targets.pop();
			json.meshes[1].weights.pop();
		},
		'nodes/1, the shells: got 1 morph targets, expected 2 as of the body',
	],
	[
		'fins without the skin',
		(json) => delete json.nodes[2].skin,
		'nodes/2, the fins: got skin none, expected 0 as of the body',
	],
	[
		'a channel without a sampler',
		(json) => (json.animations[0].channels[1].sampler = 9),
		'animations/0/channels/1: got sampler 9, expected less than 5',
	],
	[
		'keys of another number',
		(json) => json.accessors[json.animations[0].samplers[0].output].count--,
		'animations/0/channels/0/values: got 2, expected 3 for 3 keys',
	],
	[
		'values of another type',
		(json) => (json.animations[0].channels[0].target.path = 'scale'),
		'animations/0/channels/0/values: got VEC4, expected VEC3 for scale',
	],
])('refuses %s in one sentence', (_, breakIt, sentence) => {
	const json = structuredClone(made.json);
	breakIt(json);
	expect(() => checkRig(json, parts)).toThrow(new Error(`glTF/${sentence}`));
});

it('refuses a joint that the skeleton lacks', async () => {
	const json = structuredClone(made.json);
	const { bufferView } = accessors[primitive(json, 1).attributes.JOINTS_0];
	const { buffer } = json.bufferViews[bufferView];
	const bytes = Uint8Array.from(made.buffers[buffer] as Uint8Array);
	bytes[4 * 7 + 1] = nodes.length;
	json.buffers[buffer].uri = 'joints.bin';
	serve(await files({ 'joints.bin': bytes }));
	expect(await refusal(json)).toBe(
		`FUR_ptm_shells/shells: got joint ${nodes.length} at vertex 7, expected less than 3`,
	);
	serve(await files({ 'joints.bin': made.buffers[buffer] as Uint8Array }));
	expect(await refusal(json)).toBe('loaded');
});

/** Files of the asset, with others; all lists that were added lie in their own addresses. */
async function files(more: Record<string, Uint8Array>): Promise<Record<string, Uint8Array>> {
	const { golden } = await import('./assets.ts');
	const all = { ...golden('ptm-6-curves').files, ...more };
	for (const [i, { uri }] of made.json.buffers.entries())
		if (uri.startsWith('data:')) all[uri] = made.buffers[i] as Uint8Array;
	return all;
}
