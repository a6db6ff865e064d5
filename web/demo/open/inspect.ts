/** Inspection of a glTF file before any loader reads it: is all that it needs there? */

import { FUR_EXTENSION } from '../../fur/index.ts';
import { bakeCommand } from './command.ts';
import { type Container, type Files, fileOf } from './files.ts';
import { Refused } from './refusal.ts';

/** Fields that are inspected; a file may hold anything in their place. */
interface Gltf {
	asset?: { version?: unknown };
	extensions?: Record<string, unknown>;
	extensionsUsed?: unknown;
	extensionsRequired?: unknown;
	buffers?: unknown;
	bufferViews?: unknown;
	images?: unknown;
	textures?: unknown;
	nodes?: unknown;
}

const GLB = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;
const DRACO = 'KHR_draco_mesh_compression';

/** Extensions that three's loader reads without a decoder. */
const SUPPORTED =
	/^(FUR_ptm_shells|KHR_mesh_quantization|KHR_texture_transform|EXT_meshopt_compression|KHR_meshopt_compression|KHR_lights_punctual|KHR_materials_(?!variants)\w+|EXT_materials_bump|EXT_texture_(webp|avif)|EXT_mesh_gpu_instancing)$/;

/**
 * Checks everything on which the loader would fail late, or complain on the console.
 *
 * @returns `furry`: true for fur of any version
 * @throws Refused that names the file and says what is wrong with it
 */
export async function inspect(files: Files, path: string, container: Container): Promise<{ furry: boolean }> {
	const blob = files.get(path) as Blob;
	const gltf = await readGltf(blob, path);
	checkExtensions(gltf, path);
	checkNodes(gltf, path);
	for (const { uri } of [...items(gltf.buffers), ...items(gltf.images)])
		if (typeof uri === 'string' && !/^data:/i.test(uri)) fileOf(files, uri, path, container);
	await checkPictures(gltf, files, path, container);
	return { furry: Object.hasOwn(gltf.extensions ?? {}, FUR_EXTENSION) };
}

/** Reads the JSON, alone or in a .glb's first chunk. */
async function readGltf(blob: Blob, path: string): Promise<Gltf> {
	const noGltf = new Refused((words) => words.noGltf(path));
	let text = blob;
	const head = new DataView(await blob.slice(0, 20).arrayBuffer());
	if (head.byteLength === 20 && head.getUint32(0, true) === GLB) {
		const version = head.getUint32(4, true);
		if (version !== 2) throw new Refused((words) => words.oldGltf(path, String(version)));
		if (head.getUint32(8, true) > blob.size) throw new Refused((words) => words.shortGlb(path));
		if (head.getUint32(16, true) !== JSON_CHUNK) throw noGltf;
		text = blob.slice(20, 20 + head.getUint32(12, true));
	}
	let gltf: Gltf;
	try {
		gltf = JSON.parse(await text.text());
	} catch {
		throw noGltf;
	}
	const version = gltf?.asset?.version;
	if (typeof version !== 'string') throw noGltf;
	if (!version.startsWith('2')) throw new Refused((words) => words.oldGltf(path, version));
	return gltf;
}

function checkExtensions({ extensionsUsed, extensionsRequired }: Gltf, path: string): void {
	const required = new Set(names(extensionsRequired).filter((name) => !SUPPORTED.test(name)));
	// The loader fails without a decoder, required or not.
	if (names(extensionsUsed).includes(DRACO)) required.add(DRACO);
	if (required.size === 0) return;
	if (required.size === 1 && required.has(DRACO)) throw new Refused((words) => words.draco(bakeCommand(path)));
	throw new Refused((words) => words.requires([...required].join(', ')));
}

/** Refuses circles of nodes, for which a loader waits for ever: every node has to be reached from a root. */
function checkNodes({ nodes }: Gltf, path: string): void {
	const children = items(nodes).map((node) => indices(node.children));
	const parents = new Map<number, number>();
	for (const child of children.flat()) parents.set(child, (parents.get(child) ?? 0) + 1);
	const reached = [...children.keys()].filter((node) => !parents.has(node));
	for (const node of reached) {
		for (const child of children[node] ?? []) {
			const left = (parents.get(child) ?? 0) - 1;
			parents.set(child, left);
			if (left === 0) reached.push(child);
		}
	}
	if (children.some((_, node) => (parents.get(node) ?? 0) > 0)) throw new Refused((words) => words.loop(path));
}

/** Checks the images of the skin's materials: three's loader skips unreadable ones with an error on the console. */
async function checkPictures(gltf: Gltf, files: Files, path: string, container: Container): Promise<void> {
	const blob = files.get(path) as Blob;
	const [images, views, buffers] = [gltf.images, gltf.bufferViews, gltf.buffers].map(items);
	const bytesOf = async (uri: unknown): Promise<Blob> => {
		if (typeof uri !== 'string') return binaryOf(blob);
		return /^data:/i.test(uri) ? (await fetch(uri)).blob() : fileOf(files, uri, path, container);
	};
	for (const { source } of items(gltf.textures)) {
		const image = images?.[source as number];
		if (!image) continue;
		const { uri, name, mimeType } = image;
		try {
			const view = views?.[image.bufferView as number];
			let picture = await bytesOf(view ? buffers?.[view.buffer as number]?.uri : uri);
			const start = Number(view?.byteOffset ?? 0);
			if (view) picture = picture.slice(start, start + Number(view.byteLength), String(mimeType));
			(await createImageBitmap(picture)).close();
		} catch {
			const file = typeof uri === 'string' && !/^data:/i.test(uri) ? uri : undefined;
			throw new Refused((words) => words.badPicture(file ?? String(name ?? `image ${source}`)));
		}
	}
}

/** Binary chunk of a .glb. */
async function binaryOf(glb: Blob): Promise<Blob> {
	const start = 20 + new DataView(await glb.slice(12, 16).arrayBuffer()).getUint32(0, true) + 8;
	return glb.slice(start);
}

function items(value: unknown): Record<string, unknown>[] {
	return Array.isArray(value) ? value.filter((item) => item !== null && typeof item === 'object') : [];
}

function names(value: unknown): string[] {
	return Array.isArray(value) ? value.filter((item) => typeof item === 'string') : [];
}

function indices(value: unknown): number[] {
	return Array.isArray(value) ? value.filter((item) => Number.isInteger(item)) : [];
}
