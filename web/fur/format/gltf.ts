/** Check of a glTF's own JSON: three's loader trusts every reference, type and range in it. */

import { type Schema, Validator } from '@cfworker/json-schema';
import { PACKED } from '../format.ts';
import { checkSchema } from './schema.ts';

/** Bytes of a component, by accessor.componentType. */
const BYTES: Record<number, number> = { 5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4 };
/** Components of an element, by accessor.type. */
const SIZES: Record<string, number> = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT2: 4, MAT3: 9, MAT4: 16 };
/** Numbers of accessors without a buffer view together: they take memory, but no bytes of the file. */
const MAX_ZEROS = 1 << 24;

/** Span of bytes in a buffer view. */
interface Span {
	bufferView?: number;
	byteOffset?: number;
	componentType: number;
	count: number;
}

interface Accessor extends Span {
	type: string;
	min?: number[];
	max?: number[];
	sparse?: { count: number; indices: Span; values: Span };
}

/** Place of a view's bytes. */
interface Place {
	buffer: number;
	byteOffset?: number;
	byteLength: number;
	byteStride?: number;
}

/** A buffer view, and where its compressed bytes are, by the name of the extension. */
interface View extends Place {
	extensions?: Record<string, Place & { byteStride: number; count: number }>;
}

/** Lists of a glTF that this check reads. */
interface Gltf {
	nodes?: { children?: number[] }[];
	accessors?: Accessor[];
	bufferViews?: View[];
	buffers?: { byteLength: number }[];
}

/**
 * Checks all that three's loader reads of nodes, meshes, accessors, images and materials.
 *
 * @throws Error that names the place, what was got and what is expected
 */
export function checkGltf(json: object): void {
	checkSchema(new Validator(schemaOf(json as Record<string, unknown>), '2020-12'), json, 'glTF');
	const { nodes = [], accessors = [], bufferViews = [], buffers = [] } = json as Gltf;
	checkTree(nodes);
	bufferViews.forEach((view, i) => {
		const inBuffer = ({ buffer, byteOffset = 0, byteLength }: Place) =>
			expectAtMost(
				`bufferViews/${i}`,
				byteOffset + byteLength,
				buffers[buffer]?.byteLength as number,
				`in buffer ${buffer}`,
			);
		inBuffer(view);
		for (const packed of PACKED.flatMap((name) => view.extensions?.[name] ?? [])) {
			inBuffer(packed);
			const { count, byteStride } = packed;
			if (count * byteStride !== view.byteLength)
				refuse(`bufferViews/${i}`, `${count} elements of ${byteStride} bytes`, `${view.byteLength} bytes`);
		}
	});
	let zeros = 0;
	accessors.forEach((accessor, i) => {
		const { type, count, min, max, sparse } = accessor;
		const size = SIZES[type] as number;
		for (const bound of [min, max])
			if (bound && bound.length !== size) refuse(`accessors/${i}`, `a bound of ${bound.length} numbers`, `${size}`);
		checkSpan(`accessors/${i}`, accessor, size, bufferViews);
		if (accessor.bufferView === undefined) zeros += count * size;
		if (!sparse) return;
		expectAtMost(`accessors/${i}/sparse/count`, sparse.count, count, 'as the accessor');
		checkSpan(`accessors/${i}/sparse/indices`, { ...sparse.indices, count: sparse.count }, 1, bufferViews);
		const { componentType } = accessor;
		checkSpan(
			`accessors/${i}/sparse/values`,
			{ ...sparse.values, componentType, count: sparse.count },
			size,
			bufferViews,
		);
	});
	expectAtMost('accessors', zeros, MAX_ZEROS, 'numbers without a buffer view');
}

function refuse(where: string, got: string, expected: string): never {
	throw new Error(`glTF/${where}: got ${got}, expected ${expected}`);
}

function expectAtMost(where: string, got: number, most: number, what: string): void {
	if (got > most) refuse(where, `${got}`, `at most ${most} ${what}`);
}

/** Checks that three's typed array of the elements lies in the buffer view. */
function checkSpan(where: string, span: Span, size: number, views: NonNullable<Gltf['bufferViews']>): void {
	const view = views[span.bufferView as number];
	if (!view) return;
	const { byteOffset = 0, componentType, count } = span;
	const bytes = BYTES[componentType] as number;
	const element = bytes * size;
	const stride = view.byteStride ?? element;
	if (byteOffset % bytes || stride % bytes)
		refuse(where, `an offset of ${byteOffset} and a stride of ${stride} bytes`, `multiples of ${bytes}`);
	if (stride !== element) expectAtMost(where, (byteOffset % stride) + element, stride, 'bytes by its stride');
	// With a stride, three's array ends with a whole one.
	const end = stride === element ? byteOffset + count * element : (Math.floor(byteOffset / stride) + count) * stride;
	expectAtMost(where, end, view.byteLength, `bytes in buffer view ${span.bufferView}`);
}

/** Checks that nodes are trees: the loader would wait for a circle without end. */
function checkTree(nodes: { children?: number[] }[]): void {
	const parents = new Array<number | undefined>(nodes.length);
	nodes.forEach(({ children = [] }, i) => {
		for (const child of children) {
			if (parents[child] !== undefined) refuse(`nodes/${child}`, 'two parents', 'one');
			parents[child] = i;
		}
	});
	const reached = nodes.flatMap((_, i) => (parents[i] === undefined ? [i] : []));
	for (let i = 0; i < reached.length; i++) reached.push(...(nodes[reached[i] as number]?.children ?? []));
	if (reached.length < nodes.length) refuse('nodes', 'a circle of children', 'trees');
}

/** Schema of the fields that three's loader reads; references are bounded by this glTF's lists. */
// Long: one table.
function schemaOf(json: Record<string, unknown>): Schema {
	const natural: Schema = { type: 'integer', minimum: 0, maximum: 2 ** 31 };
	const number: Schema = { type: 'number', minimum: -1e30, maximum: 1e30 };
	const name: Schema = { type: 'string' };
	const list = (items: Schema, minItems = 0): Schema => ({ type: 'array', items, minItems });
	const numbers = (count: number): Schema => ({ ...list(number, count), maxItems: count });
	const map = (additionalProperties: Schema): Schema => ({ type: 'object', additionalProperties });
	const object = (properties: Record<string, Schema>, ...required: string[]): Schema => ({
		type: 'object',
		properties: { name, ...properties },
		required,
	});
	const index = (of: string): Schema => {
		const target = json[of];
		return { type: 'integer', minimum: 0, exclusiveMaximum: Array.isArray(target) ? target.length : 0 };
	};
	const texture = object({ index: index('textures'), texCoord: natural }, 'index');
	const span = { bufferView: index('bufferViews'), byteOffset: natural };
	const numeric = (...types: number[]): Schema => ({ enum: types });
	const attributes = map(index('accessors'));
	const primitive = {
		attributes,
		indices: index('accessors'),
		material: index('materials'),
		targets: list(attributes),
	};
	const pbr = object({
		baseColorFactor: numbers(4),
		metallicFactor: number,
		roughnessFactor: number,
		baseColorTexture: texture,
		metallicRoughnessTexture: texture,
	});
	const place = { translation: numbers(3), rotation: numbers(4), scale: numbers(3), matrix: numbers(16) };
	const node = { mesh: index('meshes'), skin: index('skins'), camera: index('cameras'), ...place };
	const sparse = object(
		{
			count: natural,
			indices: object({ ...span, componentType: numeric(5121, 5123, 5125) }, 'bufferView', 'componentType'),
			values: object(span, 'bufferView'),
		},
		...['count', 'indices', 'values'],
	);
	const accessor = { ...span, count: { ...natural, minimum: 1 }, sparse, min: list(number), max: list(number) };
	const kinds = { componentType: numeric(...Object.keys(BYTES).map(Number)), type: { enum: Object.keys(SIZES) } };
	const view = { byteOffset: natural, byteLength: natural, byteStride: { ...natural, minimum: 4, maximum: 252 } };
	const packed = object(
		{
			...{ buffer: index('buffers'), byteOffset: natural, byteLength: natural },
			...{ byteStride: { ...natural, minimum: 1, maximum: 256 }, count: { ...natural, minimum: 1 } },
			mode: { enum: ['ATTRIBUTES', 'TRIANGLES', 'INDICES'] },
			filter: { enum: ['NONE', 'OCTAHEDRAL', 'QUATERNION', 'EXPONENTIAL', 'COLOR'] },
		},
		...['buffer', 'byteLength', 'byteStride', 'count', 'mode'],
	);
	const extensions = object(Object.fromEntries(PACKED.map((name) => [name, packed])));
	const sampler = object({ input: index('accessors'), output: index('accessors') }, 'input', 'output');
	const channel = object({ target: object({ node: index('nodes'), path: name }) }, 'sampler', 'target');
	return object(
		{
			extensionsUsed: list(name),
			extensionsRequired: list(name),
			scene: index('scenes'),
			scenes: list(object({ nodes: list(index('nodes')) }), 1),
			nodes: list(object({ ...node, children: list(index('nodes')), weights: list(number) })),
			meshes: list(
				object(
					{
						primitives: list(object({ ...primitive, mode: { ...natural, maximum: 6 } }, 'attributes'), 1),
						weights: list(number),
					},
					'primitives',
				),
			),
			accessors: list(object({ ...accessor, ...kinds }, 'componentType', 'count', 'type')),
			bufferViews: list(object({ ...view, extensions, buffer: index('buffers') }, 'buffer', 'byteLength')),
			buffers: list(object({ uri: name, byteLength: natural }, 'byteLength')),
			images: list({
				...object({ uri: name, bufferView: index('bufferViews'), mimeType: name }),
				anyOf: [{ required: ['uri'] }, { required: ['bufferView'] }],
			}),
			textures: list({
				...object({ source: index('images'), sampler: index('samplers') }),
				anyOf: [{ required: ['source'] }, { required: ['extensions'] }],
			}),
			samplers: list(object({})),
			materials: list(
				object({
					pbrMetallicRoughness: pbr,
					normalTexture: texture,
					occlusionTexture: texture,
					emissiveTexture: texture,
					emissiveFactor: numbers(3),
					alphaMode: name,
					alphaCutoff: number,
				}),
			),
			skins: list(object({ joints: list(index('nodes')), inverseBindMatrices: index('accessors') }, 'joints')),
			cameras: list(object({ type: name }, 'type')),
			animations: list(object({ channels: list(channel), samplers: list(sampler) }, 'channels', 'samplers')),
		},
		...['scenes', 'nodes'],
	);
}
