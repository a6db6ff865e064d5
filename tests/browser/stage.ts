/** Runs inside the page: the library alone, without the demo, on assets of the tests. Its answers go to `fur.spec.ts`. */

import {
	AmbientLight,
	DirectionalLight,
	FloatType,
	HemisphereLight,
	LightProbe,
	NoBlending,
	OrthographicCamera,
	Scene,
	type Texture,
	Vector3,
	WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { type Fur, FurLoaderPlugin } from '../../web/fur/index.ts';
import { shellParameters } from '../../web/fur/shells.ts';

const renderer = new WebGLRenderer({ antialias: false });

async function load(url: string): Promise<Fur> {
	const loader = new GLTFLoader().register((parser) => new FurLoaderPlugin(parser));
	return (await loader.loadAsync(url)).userData.fur;
}

function toBase64(bytes: Uint8Array): string {
	let text = '';
	for (let i = 0; i < bytes.length; i += 0x8000) text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
	return btoa(text);
}

/** Bytes of level 0 of a texture array as the GPU holds them, layer after layer. */
function readArray(texture: Texture, size: number, layers: number): Uint8Array {
	renderer.initTexture(texture);
	const gl = renderer.getContext() as WebGL2RenderingContext;
	const handle = (renderer.properties.get(texture) as { __webglTexture: WebGLTexture }).__webglTexture;
	const framebuffer = gl.createFramebuffer();
	gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
	const bytes = new Uint8Array(size * size * layers * 4);
	for (let k = 0; k < layers; k++) {
		gl.framebufferTextureLayer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, handle, 0, k);
		if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE) throw new Error('cannot be read');
		gl.readPixels(0, 0, size, size, gl.RGBA, gl.UNSIGNED_BYTE, bytes.subarray(k * size * size * 4));
	}
	gl.bindFramebuffer(gl.FRAMEBUFFER, null);
	gl.deleteFramebuffer(framebuffer);
	renderer.resetState();
	return bytes;
}

/** A golden asset laid flat: one pixel per texel, seen from straight above. */
class Flat {
	readonly #scene = new Scene();
	readonly #camera = new OrthographicCamera(-0.5, 0.5, 0.5, -0.5, 0.1, 10);
	readonly #target: WebGLRenderTarget;
	readonly #frame: [Vector3, Vector3, Vector3];

	constructor(readonly fur: Fur) {
		const { shells, asset } = fur;
		const attribute = (name: string) =>
			new Vector3().fromBufferAttribute(shells.geometry.getAttribute(name) as never, 0);
		const n = attribute('normal').normalize();
		const t = attribute('tangent').normalize();
		const b = new Vector3().crossVectors(n, t).multiplyScalar(shells.geometry.getAttribute('tangent').getW(0));
		this.#frame = [t, b, n];
		shells.removeFromParent();
		this.#scene.add(shells);
		this.#scene.updateMatrixWorld();
		shells.geometry.computeBoundingBox();
		const centre = (shells.geometry.boundingBox?.getCenter(new Vector3()) ?? new Vector3()).applyMatrix4(
			shells.matrixWorld,
		);
		this.#camera.up.copy(b);
		this.#camera.position.copy(centre).addScaledVector(n, 5);
		this.#camera.lookAt(centre);
		this.#target = new WebGLRenderTarget(asset.size, asset.size, { type: FloatType });
		shells.material.blending = NoBlending;
		shells.geometry.instanceCount = 1;
	}

	world([x, y, z]: number[]): Vector3 {
		const [t, b, n] = this.#frame;
		return new Vector3()
			.addScaledVector(t, x ?? 0)
			.addScaledVector(b, y ?? 0)
			.addScaledVector(n, z ?? 0);
	}

	add(...lights: Parameters<Scene['add']>): void {
		this.#scene.add(...lights);
	}

	/** L of one layer's texels, the red channel's, [row, column]. */
	render(layer: number): Float32Array {
		const { asset, shells } = this.fur;
		const parameters = shells.geometry.getAttribute('shell');
		(parameters.array as Float32Array).set(shellParameters(layer, asset.layers, asset.drift));
		parameters.needsUpdate = true;
		renderer.setRenderTarget(this.#target);
		renderer.setClearColor(0, 0);
		renderer.clear();
		renderer.render(this.#scene, this.#camera);
		const pixels = new Float32Array(asset.size * asset.size * 4);
		renderer.readRenderTargetPixels(this.#target, 0, 0, asset.size, asset.size, pixels);
		return Float32Array.from({ length: pixels.length / 4 }, (_, i) => (pixels[i * 4] ?? 0) / (pixels[i * 4 + 3] ?? 0));
	}
}

const stage = {
	/** Both planes as the GPU holds them, base64. */
	async planes(url: string): Promise<string[]> {
		const { asset, shells, dispose } = await load(url);
		const planes = ['plane0', 'plane1'].flatMap((name) => shells.material.uniforms[name]?.value ?? []);
		const bytes = planes.map((texture: Texture) => toBase64(readArray(texture, asset.size, asset.layers)));
		dispose();
		return bytes;
	},

	/** The light of every texel of a golden asset under each of the lights, base64 of float32 [light, layer, row, column]. */
	async light(url: string, lights: number[][]): Promise<string> {
		const flat = new Flat(await load(url));
		const lamp = new DirectionalLight(0xffffff, 4 * Math.PI);
		flat.add(lamp, lamp.target);
		const { layers, size } = flat.fur.asset;
		const all = new Float32Array(lights.length * layers * size * size);
		lights.forEach((light, i) => {
			lamp.position.copy(flat.world(light)).multiplyScalar(10);
			for (let k = 0; k < layers; k++) all.set(flat.render(k), (i * layers + k) * size * size);
		});
		flat.fur.dispose();
		return toBase64(new Uint8Array(all.buffer));
	},

	/** Layer 0 under an environment: three's light probe of these 9 world-space harmonics, ambient and hemisphere lights. */
	async environment(
		url: string,
		probe: number[],
		ambient: number,
		hemisphere: { sky: number; ground: number; up: number[] },
	): Promise<{ light: number[]; frame: number[][] }> {
		const flat = new Flat(await load(url));
		const harmonics = new LightProbe();
		for (const [j, coefficient] of harmonics.sh.coefficients.entries()) coefficient.setScalar(probe[j] ?? 0);
		const dome = new HemisphereLight();
		dome.color.setScalar(hemisphere.sky);
		dome.groundColor.setScalar(hemisphere.ground);
		dome.position.fromArray(hemisphere.up);
		flat.add(harmonics, new AmbientLight(0xffffff, ambient), dome);
		const light = Array.from(flat.render(0), (radiance) => radiance * 4 * Math.PI);
		const frame = [
			[1, 0, 0],
			[0, 1, 0],
			[0, 0, 1],
		].map((axis) => flat.world(axis).toArray());
		flat.fur.dispose();
		return { light, frame };
	},

	/** How many shader programs there are after each of these assets has been drawn, the ones before still at hand. */
	async programs(urls: string[]): Promise<number[]> {
		const drawn: Fur[] = [];
		const counts: number[] = [];
		for (const url of urls) {
			const flat = new Flat(await load(url));
			flat.render(0);
			drawn.push(flat.fur);
			counts.push(renderer.info.programs?.length ?? 0);
		}
		for (const fur of drawn) fur.dispose();
		return counts;
	},

	/** The message with which an asset is refused, or 'loaded'. */
	async refusal(url: string): Promise<string> {
		try {
			await load(url);
			return 'loaded';
		} catch (error) {
			return (error as Error).message;
		}
	},
};

export type Stage = typeof stage;
Object.assign(window, { stage });
