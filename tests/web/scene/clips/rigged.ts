/** A baked model that tests give a skeleton of two joints and clips that move it. */

import { readdirSync, readFileSync } from 'node:fs';

export type Files = Record<string, Uint8Array<ArrayBuffer>>;

const folder = new URL('../../../../public/models/torus-512/', import.meta.url);

interface Gltf {
	nodes: { translation: number[]; scale: number[]; [name: string]: unknown }[];
	meshes: { primitives: { attributes: Record<string, number> }[] }[];
	accessors: { count: number; bufferView: number; [name: string]: unknown }[];
	bufferViews: { byteOffset: number; byteLength: number; [name: string]: unknown }[];
	buffers: { byteLength: number }[];
	[name: string]: unknown;
}

/** Appends arrays to a glTF file and its buffer. */
class Writer {
	readonly parts: Uint8Array[];
	#length: number;

	constructor(
		readonly gltf: Gltf,
		bin: Uint8Array,
	) {
		this.parts = [bin];
		this.#length = bin.byteLength;
	}

	/** @returns the index of its accessor */
	add(values: Float32Array | Uint8Array, type: string, more: object = {}): number {
		const { gltf } = this;
		const size = { SCALAR: 1, VEC3: 3, VEC4: 4, MAT4: 16 }[type] ?? 1;
		const bytes = new Uint8Array(values.buffer, values.byteOffset, values.byteLength);
		gltf.bufferViews.push({ buffer: 0, byteOffset: this.#length, byteLength: bytes.byteLength });
		const componentType = values instanceof Float32Array ? 5126 : 5121;
		gltf.accessors.push({
			...{ bufferView: gltf.bufferViews.length - 1, componentType, count: values.length / size, type },
			...more,
		});
		this.parts.push(bytes);
		this.#length += bytes.byteLength;
		return gltf.accessors.length - 1;
	}
}

/** A key of a clip: seconds, and the value then. */
type Key = [time: number, ...value: number[]];

/** A clip of the model: name, joint (0 the root, 1 its side), what moves, keys. */
export type Clip = [name: string, joint: 0 | 1, path: 'translation' | 'rotation', keys: Key[]];

const half = Math.SQRT1_2;

/** Its side is raised by a quarter turn and lowered; it leaps by 1; it goes aside by 3. */
export const CLIPS: readonly Clip[] = [
	[
		'Walk',
		1,
		'rotation',
		[
			[0, 0, 0, 0, 1],
			[1, 0, 0, half, half],
			[2, 0, 0, 0, 1],
		],
	],
	[
		'Leap',
		0,
		'translation',
		[
			[0, 0, 0, 0],
			[0.5, 0, 1, 0],
			[1, 0, 0, 0],
		],
	],
	[
		'Go',
		0,
		'translation',
		[
			[0, 0, 0, 0],
			[1, 3, 0, 0],
		],
	],
];

/** The furry ring of 512 triangles, 2 wide, its right half on a joint in its middle. */
export function rigged(clips: readonly Clip[] = CLIPS): Files {
	const files: Files = {};
	for (const name of readdirSync(folder)) files[name] = new Uint8Array(readFileSync(new URL(name, folder)));
	const gltf: Gltf = JSON.parse(new TextDecoder().decode(files['model.gltf']));
	const bin = files['model.bin'] as Uint8Array<ArrayBuffer>;
	const writer = new Writer(gltf, bin);
	for (const { primitives } of gltf.meshes) {
		for (const { attributes } of primitives) {
			const { count, bufferView } = gltf.accessors[attributes.POSITION as number] as Gltf['accessors'][0];
			const { byteOffset } = gltf.bufferViews[bufferView] as Gltf['bufferViews'][0];
			const [joints, weights] = [new Uint8Array(4 * count), new Uint8Array(4 * count)];
			for (let v = 0; v < count; v++) {
				const x = new DataView(bin.buffer, bin.byteOffset + byteOffset + 8 * v).getUint16(0, true) / 65535;
				const share = Math.round(255 * Math.min(Math.max(5 * (x - 0.4), 0), 1));
				joints[4 * v + 1] = 1;
				weights.set([255 - share, share], 4 * v);
			}
			attributes.JOINTS_0 = writer.add(joints, 'VEC4');
			attributes.WEIGHTS_0 = writer.add(weights, 'VEC4', { normalized: true });
		}
	}
	const first = gltf.nodes.length;
	const { translation, scale: scales } = gltf.nodes[0] as Gltf['nodes'][0];
	const [x, y, z] = translation as [number, number, number];
	const [scale] = scales as [number];
	for (const node of gltf.nodes) node.skin = 0;
	gltf.nodes.push({ name: 'root', children: [first + 1] } as never, { name: 'side', rotation: [0, 0, 0, 1] } as never);
	const inverse = [scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, scale, 0, x, y, z, 1];
	gltf.skins = [
		{
			joints: [first, first + 1],
			inverseBindMatrices: writer.add(new Float32Array([...inverse, ...inverse]), 'MAT4'),
		},
	];
	gltf.scenes = [{ nodes: [0, first] }];
	gltf.animations = clips.map(([name, joint, path, keys]) => {
		const times = keys.map(([time]) => time);
		const range = { min: [Math.min(...times)], max: [Math.max(...times)] };
		const input = writer.add(new Float32Array(times), 'SCALAR', range);
		const values = new Float32Array(keys.flatMap(([, ...value]) => value));
		const output = writer.add(values, path === 'rotation' ? 'VEC4' : 'VEC3');
		const target = { node: first + joint, path };
		return { name, samplers: [{ input, output }], channels: [{ sampler: 0, target }] };
	});
	const whole = Buffer.concat(writer.parts);
	(gltf.buffers[0] as { byteLength: number }).byteLength = whole.byteLength;
	const text = new TextEncoder().encode(JSON.stringify(gltf));
	return { ...files, 'model.bin': new Uint8Array(whole), 'model.gltf': new Uint8Array(text) };
}
