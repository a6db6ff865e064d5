/** Runs inside the page: wet and dirty fur, on a golden asset and on a body that wears it. Answers to `weather.spec.ts`. */

import {
	type CompressedArrayTexture,
	DirectionalLight,
	LoadingManager,
	PerspectiveCamera,
	type Texture,
	Vector3,
} from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { dressFur, type Fur, FurInstances, FurLoaderPlugin, FurWeather, furMethod } from '../../../web/fur/index.ts';
import { loadFur, Studio } from '../../../web/measure/studio.ts';
import { Flat, renderer } from './flat.ts';
import { toBase64 } from './Stand.ts';

interface Weather {
	wetness: number;
	dirt: number;
}

/** Lit from the front right, as bright as the golden lights' lamp. */
class Wet {
	readonly flat: Flat;
	readonly weather: FurWeather;
	readonly lamp = new DirectionalLight(0xffffff, 4 * Math.PI);

	constructor(readonly fur: Fur) {
		this.flat = new Flat(fur);
		this.flat.add(this.lamp, this.lamp.target);
		this.light([0.3, 0.4, 0.8]);
		this.weather = new FurWeather(fur);
	}

	light(direction: number[]): void {
		this.lamp.position.copy(this.flat.world(direction)).multiplyScalar(10);
	}

	set({ wetness, dirt }: Weather): void {
		Object.assign(this.weather, { wetness, dirt });
		this.fur.update(0);
	}

	/** All layers, [layer, row, column]. */
	all(): Float32Array {
		const { layers, size } = this.fur.asset;
		const light = new Float32Array(layers * size * size);
		for (let k = 0; k < layers; k++) light.set(this.flat.light(k), k * size * size);
		return light;
	}

	/** Layers of the textures of shells and fins. */
	depths(): number[] {
		const { textures, finTextures } = this.fur;
		return [textures.plane0, textures.plane1, finTextures?.plane0].map(depthOf);
	}

	get parts(): string[] {
		return ['WET', 'DIRTY', 'MUD'].filter((part) => part in this.fur.material.defines);
	}

	dispose(): void {
		this.weather.dispose();
		this.fur.dispose();
	}
}

const depthOf = (texture: Texture | undefined): number => (texture as CompressedArrayTexture).image.depth;

const worst = (a: Float32Array, b: Float32Array) =>
	a.reduce((most, value, i) => Math.max(most, Math.abs(value - (b[i] ?? Number.NaN))), 0);

/** Resolves once the driest state in the textures is this one. */
async function settled({ fur }: Wet, wetness: number): Promise<void> {
	const started = performance.now();
	const driest = () => fur.pelt.wet[0]?.wetness ?? 0;
	while (driest() !== wetness) {
		if (performance.now() - started > 10_000) throw new Error(`the driest state is ${driest()}, not ${wetness}`);
		await new Promise((resolve) => setTimeout(resolve, 5));
	}
}

/** Red radiance · 4π in these weathers under each of the lights, base64 of float32 [weather, light, layer, row, column]. */
export async function weathers(url: string, lights: number[][], given: Weather[]): Promise<string> {
	const wet = new Wet(await loadFur(url));
	await wet.fur.loadStates();
	const found = given.flatMap((weather) => {
		wet.set(weather);
		return lights.map((light) => {
			wet.light(light);
			return wet.all();
		});
	});
	wet.dispose();
	const all = new Float32Array(found.length * (found[0]?.length ?? 0));
	for (const [i, light] of found.entries()) all.set(light, i * light.length);
	return toBase64(new Uint8Array(all.buffer));
}

/** One model through all that there is: what is drawn, with which parts, how deep the textures are. */
export async function course(url: string) {
	const { textures } = renderer.info.memory;
	const wet = new Wet(await loadFur(url));
	const before = wet.all();
	wet.set({ wetness: 1, dirt: 0 });
	const unloaded = { parts: wet.parts, same: worst(wet.all(), before), depths: wet.depths(), has: wet.fur.states };
	wet.weather.clean();
	wet.fur.update(0);
	await wet.fur.loadStates();
	const dry = { parts: wet.parts, same: worst(wet.all(), before), depths: wet.depths() };
	wet.set({ wetness: 0.75, dirt: 0 });
	const atState = wet.all();
	wet.set({ wetness: 0.6, dirt: 0 });
	const between = wet.all();
	const soaking = { parts: wet.parts, differs: worst(between, before) };
	wet.set({ wetness: 0, dirt: 1 });
	const muddy = { parts: wet.parts, differs: worst(wet.all(), before) };
	wet.weather.clean();
	wet.fur.update(0);
	const clean = { parts: wet.parts, same: worst(wet.all(), before) };

	const light = new Wet(await loadFur(url, { states: 2 }));
	await light.fur.loadStates();
	const depths = [light.depths()];
	light.set({ wetness: 0.75, dirt: 0 });
	await settled(light, 0.75);
	depths.push(light.depths());
	const tier = [worst(light.all(), atState)];
	light.set({ wetness: 0.6, dirt: 0 });
	await settled(light, 0.5);
	tier.push(worst(light.all(), between));
	light.set({ wetness: 0, dirt: 1 });
	const lightMud = { parts: light.parts };
	light.weather.clean();
	light.fur.update(0);
	depths.push(light.depths());
	tier.push(worst(light.all(), before));
	light.dispose();
	wet.dispose();
	const left = renderer.info.memory.textures - textures;
	return {
		unloaded,
		dry,
		soaking,
		muddy,
		clean,
		depths,
		tier,
		lightMud,
		left,
		error: renderer.getContext().getError(),
	};
}

/** Wetness of the two states that a pelt has ready for a body which is dressed in it. @param wetness of the body */
export async function worn(url: string, wetness: number): Promise<number[]> {
	const [body, pelt] = await Promise.all([loadFur(url), loadFur(url, { states: 2 })]);
	const weather = new FurWeather(body);
	const dressed = dressFur(body, pelt);
	await dressed.loadStates();
	weather.wetness = wetness;
	body.update(0);
	const { pelt: states } = dressed;
	for (let i = 0; i < 200 && states.wet.length < 2; i++) await new Promise((resolve) => setTimeout(resolve, 10));
	const ready = states.wet.map((state) => state.wetness ?? 0);
	weather.dispose();
	for (const fur of [dressed, pelt, body]) fur.dispose();
	return ready;
}

/** Every switch of the shaders with wet and dirty fur, in rivals and herds too: what of the picture is darker than dry. */
export async function switches(url: string) {
	const fur = await loadFur(url);
	await fur.loadStates();
	const studio = new Studio(renderer, fur, 48, 48);
	studio.look(0, 0.5);
	studio.showFur(6, true);
	const weather = new FurWeather(fur);
	const brightness = (pixels: Float32Array) => pixels.reduce((sum, value, i) => sum + (i % 4 < 3 ? value : 0), 0);
	const ratio = (dirty: boolean) => {
		weather.clean();
		fur.update(0);
		const dry = brightness(studio.draw());
		weather.wetness = 1;
		fur.update(0);
		const wet = brightness(studio.draw()) / dry;
		if (dirty) weather.dirt = 0.5;
		fur.update(0);
		return [wet, dirty ? brightness(studio.draw()) / dry : 0];
	};
	Object.assign(fur.material, { gloss: 0.5, backlight: 2, density: 1.2 });
	const perVertex = ratio(true);
	fur.material.lampsPerFragment = true;
	fur.length = 0.6 * fur.asset.length;
	const perFragment = ratio(true);
	const rivals = (['unlit', 'lengyel', 'shadow-layers'] as const).map((name) => {
		const method = furMethod(fur, name, { renderer });
		method.apply();
		const [wet] = ratio(false);
		method.dispose();
		return wet;
	});
	fur.length = fur.asset.length;
	const other = dressFur(fur, fur);
	const dressed = other.weather === weather && 'WET' in other.material.defines;
	other.dispose();
	const herd = new FurInstances(fur, 1);
	herd.update(new PerspectiveCamera());
	const followed = herd.children.map((part) => 'material' in part && (part.material as typeof fur.material).defines);
	herd.dispose();
	weather.dispose();
	studio.dispose();
	return {
		ratios: { perVertex, perFragment },
		rivals,
		dressed,
		herd: followed.filter((defines) => defines && 'WET' in defines).length,
		error: renderer.getContext().getError(),
	};
}

/** Rain on one corner of the golden square: the radiance of its texels before and after, layer by layer. */
export async function corner(url: string) {
	const wet = new Wet(await loadFur(url));
	await wet.fur.loadStates();
	const before = wet.all();
	const { shells } = wet.fur;
	shells.geometry.computeBoundingBox();
	const { min } = shells.geometry.boundingBox ?? { min: new Vector3() };
	wet.weather.rain(min.clone().applyMatrix4(shells.matrixWorld), 0.5, 1);
	wet.fur.update(0);
	const after = wet.all();
	const { driest, wettest } = wet.weather;
	wet.dispose();
	return { before: [...before], after: [...after], driest, wettest };
}

/** A model from memory, whose addresses are taken back as soon as it is there. */
export async function dropped(url: string): Promise<number[]> {
	const made: string[] = [];
	const manager = new LoadingManager();
	const files = new Map<string, string>();
	const { images, buffers } = await (await fetch(url)).json();
	for (const { uri } of [...images, ...buffers, { uri: 'model.gltf' }]) {
		const address = URL.createObjectURL(await (await fetch(url.replace('model.gltf', uri))).blob());
		files.set(uri, address);
		made.push(address);
	}
	manager.setURLModifier((given) => files.get(given.split('/').at(-1) ?? '') ?? given);
	const loader = new GLTFLoader(manager).register((parser) => new FurLoaderPlugin(parser));
	const { fur } = (await loader.loadAsync('own:/model.gltf')).userData;
	for (const address of made) URL.revokeObjectURL(address);
	await fur.loadStates();
	const wet = new Wet(fur);
	const depths = wet.depths();
	wet.dispose();
	return depths;
}

/** Loads the states once or more often: what each attempt says, and how deep the textures are then. */
export async function attempts(url: string, times: number): Promise<[said: string, depth: number][]> {
	const fur = await loadFur(url);
	const said: [string, number][] = [];
	for (let i = 0; i < times; i++) {
		const answer = await fur.loadStates().then(
			() => 'loaded',
			(error: Error) => error.message,
		);
		said.push([answer, depthOf(fur.textures.plane0)]);
	}
	fur.dispose();
	return said;
}
