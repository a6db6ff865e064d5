import type { GLTF, GLTFLoaderPlugin, GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import { FUR_EXTENSION, FUR_VERSION, type FurAsset, isNewer } from './format.ts';
import type { FurLoaderOptions } from './load/options.ts';
import { checkLimits } from './planes/furLimits.ts';
import { GltfFiles } from './planes/GltfFiles.ts';
import { isPacked, meshDecoder } from './planes/meshopt.ts';
import { fetchParts } from './shells/parts/parts.ts';

export type { FurLoaderOptions };

/** The parts of a glTF that say whether anything moves. */
interface Rigged {
	skins?: unknown[];
	meshes?: { primitives?: { targets?: unknown[] }[] }[];
}

/** Code for an asset, which may be broken as yet: that of all fur, and the parts that this one has. */
async function codeFor({ skins, meshes }: Rigged, { fins, edges, regions, curves }: Partial<FurAsset>) {
	const moves = skins || (Array.isArray(meshes) && JSON.stringify(meshes).includes('"targets"'));
	const [{ growFur }, ofFins] = await Promise.all([
		import('./load/growFur.ts'),
		(fins ?? edges) === undefined ? undefined : import('./load/fins.ts'),
		fetchParts([
			...(regions ? (['regions'] as const) : []),
			...(moves ? (['pose'] as const) : []),
			...(curves ? [] : (['horizon'] as const)),
		]),
	]);
	return { growFur, fins: ofFins };
}

/**
 * Plugin for three's GLTFLoader: an asset with `FUR_ptm_shells` grows its fur, any other loads as ever.
 *
 *     const loader = new GLTFLoader().register((parser) => new FurLoaderPlugin(parser));
 *     const gltf = await loader.loadAsync('bunny/model.gltf');
 *     scene.add(gltf.scene);
 *
 * A newer version of the format shows the skin alone, with a warning. Broken data rejects the promise with an
 * Error that says what is wrong.
 */
export class FurLoaderPlugin implements GLTFLoaderPlugin {
	/** Name of the extension. */
	readonly name = FUR_EXTENSION;
	readonly #parser: GLTFParser;
	readonly #options: FurLoaderOptions;
	readonly #files: GltfFiles;
	#checks: typeof import('./checks.ts') | undefined;
	readonly #code: ReturnType<typeof codeFor> | undefined;

	constructor(parser: GLTFParser, options: FurLoaderOptions = {}) {
		this.#parser = parser;
		this.#options = options;
		this.#files = new GltfFiles(parser);
		const packed = isPacked(parser.json);
		if (packed) parser.options.meshoptDecoder ??= meshDecoder();
		if (!this.#extension) return;
		// Beside its files, not after them.
		if (!isNewer(this.#extension)) this.#code = codeFor(parser.json, this.#extension);
		this.#code?.catch(() => {}); // awaited by afterRoot
		if (options.check !== false) this.#checkFirst();
		// The loader itself fetches the buffer of compressed views: it has to arrive whole, too.
		if (packed) parser.loadBuffer = (index) => this.#files.buffer(index);
	}

	get #extension() {
		return this.#parser.json.extensions?.[FUR_EXTENSION];
	}

	/** Lets three's loader wait for the checks: it would read a broken glTF without a look. */
	#checkFirst(): void {
		const parser = this.#parser;
		const parse = parser.parse.bind(parser);
		parser.parse = (onLoad, onError) => {
			const checked = import('./checks.ts').then((checks) => {
				checks.checkModel(parser.json);
				this.#checks = checks;
			});
			checked.then(() => parse(onLoad, onError), onError);
		};
	}

	/** Called by the loader: reads from a buffer that has arrived whole. */
	loadBufferView(index: number): Promise<ArrayBuffer> | null {
		if (!this.#extension) return null;
		return this.#files.bufferView(index);
	}

	/** Called by the loader: grows the fur. */
	async afterRoot(gltf: GLTF): Promise<void> {
		const extension = this.#extension;
		if (!extension) return;
		if (isNewer(extension)) {
			const warn = (version: string) =>
				console.warn(`${FUR_EXTENSION}: version ${version} is newer than ${FUR_VERSION}; showing the skin alone`);
			return (this.#options.newer ?? warn)(extension.version);
		}
		const asset: FurAsset = extension;
		if (this.#options.limits) checkLimits(asset, this.#options.limits);
		const { growFur, fins } = await (this.#code as ReturnType<typeof codeFor>);
		const [parser, files, options, check] = [this.#parser, this.#files, this.#options, this.#checks?.checkGeometry];
		gltf.userData.fur = await growFur(asset, gltf.scene, { parser, files, options, fins, check });
	}
}
