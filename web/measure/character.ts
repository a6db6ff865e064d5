/** Cost of a body that moves by its joints and targets, printed by `npm run character`. */

import { AnimationMixer, WebGLRenderer } from 'three';
import { type GLTF, GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { type Fur, FurLoaderPlugin, FurMotion } from '../fur/index.ts';
import type { CharacterCost, CharacterFigures } from './figures.ts';
import { median, perRound, ratio, thereAndBack } from './statistics.ts';
import { Studio } from './studio.ts';

const SECONDS = 1 / 60; // simulated length of a frame

/** Modes compared: a statue of the same vertices, the character in that pose, in its clip, and there with springs. */
const MODES = ['statue', 'held', 'moving', 'springs'] as const;

type Mode = (typeof MODES)[number];

/** glTF without anything that moves it; its vertices keep their attributes. */
function statueOf(text: string): string {
	const { animations: _, skins: __, ...json } = JSON.parse(text);
	for (const node of json.nodes) delete node.skin;
	for (const mesh of json.meshes) {
		delete mesh.weights;
		for (const primitive of mesh.primitives) delete primitive.targets;
	}
	return JSON.stringify(json);
}

/** @param text of a model.gltf @param folder its address, with a slash at the end */
function parse(text: string, folder: string): Promise<GLTF> {
	const loader = new GLTFLoader().register((parser) => new FurLoaderPlugin(parser));
	return loader.parseAsync(text, folder);
}

/** A body of its own scene, with what moves it. */
class Subject {
	readonly #studio: Studio;
	readonly #step: () => void;

	constructor(gltf: GLTF, mode: Mode, renderer: WebGLRenderer, width: number, height: number) {
		const fur: Fur = gltf.userData.fur;
		this.#studio = new Studio(renderer, fur, width, height);
		const mixer = new AnimationMixer(gltf.scene);
		const [clip] = gltf.animations;
		if (clip && mode !== 'statue') mixer.clipAction(clip).play();
		mixer.update(0);
		if (mode === 'held') {
			mixer.stopAllAction();
			fur.shells.skeleton?.pose();
		}
		if (mode === 'springs') new FurMotion(fur, { renderer });
		const moves = mode === 'moving' || mode === 'springs';
		this.#step = () => {
			if (moves) mixer.update(SECONDS);
			fur.update(SECONDS);
		};
	}

	/** @returns milliseconds of script, and of the whole frame up to the GPU's end */
	frame(): [script: number, whole: number] {
		const start = performance.now();
		this.#step();
		const moved = performance.now() - start;
		return [moved, moved + this.#studio.time()];
	}

	dispose(): void {
		this.#studio.dispose();
	}
}

/**
 * @param url of a character's model.gltf
 * @param rounds rounds of a turn there and a turn back for each mode
 * @param frames frames of a turn, after one that does not count
 */
export async function measureCharacter(
	url: string,
	{ width = 1280, height = 720, rounds = 8, frames = 4 } = {},
): Promise<CharacterFigures> {
	const text = await (await fetch(url)).text();
	const folder = url.slice(0, url.lastIndexOf('/') + 1);
	const renderer = new WebGLRenderer({ antialias: false });
	const subjects = new Map<Mode, Subject>();
	let joints = 0;
	for (const mode of MODES) {
		const gltf = await parse(mode === 'statue' ? statueOf(text) : text, folder);
		joints = Math.max(joints, gltf.userData.fur.shells.skeleton?.bones.length ?? 0);
		subjects.set(mode, new Subject(gltf, mode, renderer, width, height));
	}
	const script: Record<Mode, number[]> = { statue: [], held: [], moving: [], springs: [] };
	const turns: Record<Mode, number[]> = { statue: [], held: [], moving: [], springs: [] };
	for (let round = -1; round < rounds; round++) {
		for (const mode of thereAndBack(MODES)) {
			const subject = subjects.get(mode) as Subject;
			subject.frame();
			const times = Array.from({ length: frames }, () => subject.frame());
			// Skip the first round, which compiles.
			if (round < 0) continue;
			script[mode].push(...times.map(([moved]) => moved));
			turns[mode].push(times.reduce((sum, [, whole]) => sum + whole, 0) / frames);
		}
	}
	const base = perRound(turns.statue);
	const costs = MODES.map((mode): CharacterCost => {
		const each = perRound(turns[mode]);
		return { mode, frame: median(each), ratio: ratio(each, base), script: median(script[mode]) };
	});
	for (const subject of subjects.values()) subject.dispose();
	renderer.dispose();
	return { width, height, joints, costs };
}
