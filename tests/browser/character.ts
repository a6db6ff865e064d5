/** A small character made of a still asset: three joints in a row, two morph targets, a clip. */

import { readFile } from 'node:fs/promises';
import { Euler, Matrix4, Quaternion, Vector3 } from 'three';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import { repository } from './library.ts';
import { type Json, PosedGltf } from './posed.ts';

/** Joint at rest: place in its parent, turn. */
interface Joint {
	name: string;
	translation: [number, number, number];
	angles: [number, number, number];
}

const JOINTS: Joint[] = [
	{ name: 'hip', translation: [0, 0.1, 0], angles: [0.3, 0, 0.2] },
	{ name: 'chest', translation: [0.2, 0, 0.1], angles: [0, -0.4, 0] },
	{ name: 'head', translation: [0.4, 0.1, 0], angles: [0.5, 0.2, 0] },
];
/** Names of the morph targets. */
const TARGETS = ['swell', 'lean'];

const turned = (angles: readonly number[]) =>
	new Quaternion().setFromEuler(new Euler(...(angles as [number, number, number]))).toArray();

export interface Made {
	json: Json;
	buffers: Uint8Array[];
}

/** Bytes added to a glTF, each list in a buffer of its own. */
class Additions {
	constructor(readonly made: Made) {}

	/** @returns index of the accessor */
	add(
		values: ArrayLike<number> & { buffer: ArrayBufferLike },
		type: string,
		componentType: number,
		normalized = false,
	): number {
		const { json, buffers } = this.made;
		const bytes = new Uint8Array(values.buffer);
		const size = { SCALAR: 1, VEC3: 3, VEC4: 4, MAT4: 16 }[type] ?? 1;
		json.buffers.push({
			byteLength: bytes.length,
			uri: `data:application/octet-stream;base64,${Buffer.from(bytes).toString('base64')}`,
		});
		buffers.push(bytes);
		json.bufferViews.push({ buffer: json.buffers.length - 1, byteLength: bytes.length });
		const [min, max] = [Math.min, Math.max].map((pick) =>
			Array.from({ length: size }, (_, c) =>
				Array.from(values)
					.filter((_, i) => i % size === c)
					.reduce((a, b) => pick(a, b)),
			),
		);
		json.accessors.push({
			bufferView: json.bufferViews.length - 1,
			componentType,
			count: values.length / size,
			type,
			...(normalized && { normalized }),
			...(type !== 'MAT4' && componentType === 5126 && { min, max }),
		});
		return json.accessors.length - 1;
	}
}

/** Weights of the three joints at a place, in 255ths. */
type Weights = (x: number, y: number, z: number) => [number, number, number];

/** Joints take over from left to right. */
const fromLeft: Weights = (x) => {
	const first = Math.round(255 * Math.min(Math.max(0.5 - x, 0), 1));
	const last = Math.min(255 - first, Math.round(255 * Math.min(Math.max(0.2 + 0.8 * x, 0), 1)));
	return [first, 255 - first - last, last];
};

/**
 * The asset of a folder as a character; its rest pose is the still body.
 *
 * @param weights of the joints
 */
export async function character(folder = 'public/models/torus-512', weights: Weights = fromLeft): Promise<Made> {
	const json: Json = JSON.parse(await readFile(`${repository}${folder}/model.gltf`, 'utf8'));
	const bin = await readFile(`${repository}${folder}/${json.buffers[0].uri}`);
	const made: Made = { json, buffers: [new Uint8Array(bin), ...(await unpack(json, bin))] };
	const additions = new Additions(made);
	const fur = json.extensions.FUR_ptm_shells;
	fur.version = '2.1';
	const [first] = json.nodes;
	const place = new Matrix4().compose(
		new Vector3().fromArray(first.translation),
		new Quaternion(),
		new Vector3().fromArray(first.scale),
	);
	const still = new PosedGltf(json, made.buffers);
	// Edges are of fins of bodies that nothing moves.
	delete fur.edges;
	for (const node of [fur.skin, fur.shells, ...(fur.fins === undefined ? [] : [fur.fins])]) {
		json.nodes[node].skin = 0;
		for (const primitive of json.meshes[json.nodes[node].mesh].primitives)
			bendPrimitive(additions, still, primitive, place, weights, node !== fur.skin);
		const mesh = json.meshes[json.nodes[node].mesh];
		mesh.weights = TARGETS.map(() => 0);
		mesh.extras = { targetNames: TARGETS };
	}
	const root = json.nodes.length;
	let world = new Matrix4();
	const inverses: number[] = [];
	for (const [j, { name, translation, angles }] of JOINTS.entries()) {
		const rotation = turned(angles);
		json.nodes.push({ name, translation, rotation, ...(j < JOINTS.length - 1 && { children: [root + j + 1] }) });
		const own = new Matrix4().compose(
			new Vector3().fromArray(translation),
			new Quaternion().fromArray(rotation),
			new Vector3(1, 1, 1),
		);
		world = world.clone().multiply(own);
		inverses.push(...world.clone().invert().multiply(place).elements);
	}
	json.scenes[0].nodes.push(root);
	const inverseBindMatrices = additions.add(Float32Array.from(inverses), 'MAT4', 5126);
	json.skins = [{ joints: JOINTS.map((_, j) => root + j), inverseBindMatrices }];
	json.animations = [wave(additions, root, fur.skin)];
	return made;
}

/** Lets compressed views be as they were. @returns buffer that they are in, if there are any */
async function unpack(json: Json, bin: Uint8Array): Promise<Uint8Array[]> {
	const fallback = json.buffers[1];
	if (!fallback) return [];
	await MeshoptDecoder.ready;
	const bytes = new Uint8Array(fallback.byteLength);
	for (const view of json.bufferViews) {
		const packed = view.extensions?.EXT_meshopt_compression;
		if (!packed) continue;
		const { byteOffset = 0, byteLength, count, byteStride, mode, filter } = packed;
		const target = bytes.subarray(view.byteOffset, view.byteOffset + count * byteStride);
		MeshoptDecoder.decodeGltfBuffer(
			target,
			count,
			byteStride,
			bin.subarray(byteOffset, byteOffset + byteLength),
			mode,
			filter,
		);
		delete view.extensions;
	}
	delete fallback.extensions;
	fallback.uri = `data:application/octet-stream;base64,${Buffer.from(bytes).toString('base64')}`;
	for (const key of ['extensionsRequired', 'extensionsUsed'])
		json[key] = json[key].filter((name: string) => name !== 'EXT_meshopt_compression');
	return [bytes];
}

/** Joints, weights and targets of the vertices of a primitive. */
function bendPrimitive(
	additions: Additions,
	still: PosedGltf,
	primitive: Json,
	place: Matrix4,
	weights: Weights,
	tangents: boolean,
): void {
	const local = still.numbers(primitive.attributes.POSITION);
	const count = local.length / 3;
	const point = new Vector3();
	const joints = new Uint8Array(4 * count);
	const shares = new Uint8Array(4 * count);
	const changes = TARGETS.map(() => new Float32Array(3 * count));
	const turns = TARGETS.map(() => new Float32Array(3 * count));
	for (let v = 0; v < count; v++) {
		point.fromArray(local, 3 * v);
		const { x, y, z } = point.applyMatrix4(place);
		joints.set([0, 1, 2, 0], 4 * v);
		shares.set([...weights(x, y, z), 0], 4 * v);
		const scale = place.getMaxScaleOnAxis();
		const swell = 0.15 * Math.exp(-4 * (x - 0.5) ** 2);
		changes[0]?.set([(swell * x) / scale, (swell * y) / scale, (swell * z) / scale], 3 * v);
		changes[1]?.set([(0.2 * y) / scale, 0, 0], 3 * v);
		turns[1]?.set([0.1, -0.05, 0], 3 * v);
	}
	primitive.attributes.JOINTS_0 = additions.add(joints, 'VEC4', 5121);
	primitive.attributes.WEIGHTS_0 = additions.add(shares, 'VEC4', 5121, true);
	primitive.targets = TARGETS.map((_, t) => ({
		POSITION: additions.add(changes[t] as Float32Array, 'VEC3', 5126),
		NORMAL: additions.add(turns[t] as Float32Array, 'VEC3', 5126),
		...(tangents && { TANGENT: additions.add(turns[t] as Float32Array, 'VEC3', 5126) }),
	}));
}

/** A clip of one second that uses every kind of key. */
function wave(additions: Additions, root: number, skin: number): Json {
	const times = additions.add(Float32Array.of(0, 0.5, 1), 'SCALAR', 5126);
	const floats = (values: number[], type: string) => additions.add(Float32Array.from(values), type, 5126);
	const [, chest, head] = JOINTS as [Joint, Joint, Joint];
	const turns = (joint: Joint, by: number[]) =>
		by.flatMap((angle) => turned([joint.angles[0], joint.angles[1] + angle, joint.angles[2] + 0.7 * angle]));
	const flat = [0, 0, 0];
	const samplers = [
		{ input: times, output: floats(turns(chest, [0, 0.9, -0.6]), 'VEC4') },
		{ input: times, output: floats(turns(head, [0.2, -1.1, 0.8]), 'VEC4'), interpolation: 'STEP' },
		{
			input: times,
			output: floats(
				[...flat, 0, 0.1, 0, 0.5, 0, 0, ...flat, 0, 0.4, 0.1, ...flat, ...flat, 0.2, 0, 0, ...flat],
				'VEC3',
			),
			interpolation: 'CUBICSPLINE',
		},
		{ input: times, output: floats([0, 0, 1, 0.3, -0.2, 1], 'SCALAR') },
		{ input: times, output: floats([1, 1, 1, 1.3, 1.3, 1.3, 0.8, 0.8, 0.8], 'VEC3') },
	];
	const target = (node: number, path: string) => ({ node, path });
	const channels = [
		target(root + 1, 'rotation'),
		target(root + 2, 'rotation'),
		target(root, 'translation'),
		target(skin, 'weights'),
		target(root + 2, 'scale'),
	].map((to, sampler) => ({ sampler, target: to }));
	return { name: 'Wave', channels, samplers };
}
