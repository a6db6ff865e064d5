/** Bodies that move in tests, without a GPU. */

import { readFileSync } from 'node:fs';
import { BufferAttribute, BufferGeometry, type DataTexture, Group, Mesh, type Texture } from 'three';
import { FurFollicles } from '../../../web/fur/body/FurFollicles.ts';
import type { Fur } from '../../../web/fur/Fur.ts';
import type { FurMotion } from '../../../web/fur/motion/FurMotion.ts';

const TYPES = {
	5120: Int8Array,
	5121: Uint8Array,
	5122: Int16Array,
	5123: Uint16Array,
	5125: Uint32Array,
	5126: Float32Array,
} as const;
const SIZES: Record<string, number> = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };

/** What a FurMotion takes of a fur, in a group that can be moved. */
export interface Body {
	readonly fur: Fur;
	readonly place: Group;
}

/** A fur of this surface. @param length of the longest, model units; @param shells its mesh */
export function bodyOf(geometry: BufferGeometry, length: number, scale = 1, shells = new Mesh(geometry)): Body {
	shells.scale.setScalar(scale);
	const place = new Group().add(shells);
	const fur = {
		...{ shells, asset: { length }, follicles: FurFollicles.of(geometry) },
		swing: undefined as Texture | undefined,
		set motion(motion: FurMotion | undefined) {
			const detach = () => {
				fur.swing = undefined;
			};
			motion?.join({ follow: () => (fur.swing = motion.swing), detach });
		},
	};
	return { fur: fur as unknown as Fur, place };
}

/** A body of public/models whose meshes are stored as they are. @param part whose mesh */
export function load(name: string, part: 'shells' | 'fins' = 'shells'): Body {
	const at = (file: string) => new URL(`../../../public/models/${name}/${file}`, import.meta.url);
	const gltf = JSON.parse(readFileSync(at('model.gltf'), 'utf8'));
	const { buffer, byteOffset } = readFileSync(at('model.bin'));
	const asset = gltf.extensions.FUR_ptm_shells;
	const node = gltf.nodes[asset[part]];
	const attribute = (index: number) => {
		const { bufferView, byteOffset: own = 0, componentType, count, type, normalized } = gltf.accessors[index];
		const view = gltf.bufferViews[bufferView];
		const Type = TYPES[componentType as keyof typeof TYPES];
		const size = SIZES[type] as number;
		const stride = (view.byteStride ?? size * Type.BYTES_PER_ELEMENT) / Type.BYTES_PER_ELEMENT;
		const values = new Type(count * size);
		const start = byteOffset + (view.byteOffset ?? 0) + own;
		const all = new Type(buffer.slice(start, start + ((count - 1) * stride + size) * Type.BYTES_PER_ELEMENT));
		for (let i = 0; i < count; i++) for (let c = 0; c < size; c++) values[i * size + c] = all[i * stride + c] as number;
		return new BufferAttribute(values, size, normalized);
	};
	const { attributes, indices } = gltf.meshes[node.mesh].primitives[0];
	const geometry = new BufferGeometry().setIndex(attribute(indices));
	for (const [semantic, index] of Object.entries<number>(attributes))
		geometry.setAttribute(semantic === 'TEXCOORD_0' ? 'uv' : semantic.toLowerCase(), attribute(index));
	const body = bodyOf(geometry, asset.length);
	body.fur.shells.position.fromArray(node.translation);
	body.fur.shells.scale.fromArray(node.scale);
	return body;
}

/** Three numbers of each follicle. */
export function swingOf({ fur }: Body): Float32Array {
	const { count } = fur.follicles;
	const texels = (fur.swing as DataTexture | undefined)?.image.data;
	return Float32Array.from({ length: 3 * count }, (_, i) => texels?.[4 * Math.floor(i / 3) + (i % 3)] ?? 0);
}
