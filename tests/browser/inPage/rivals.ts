/** Runs inside the page: fur in the light of its rivals. Its answers go to `baselines.spec.ts`. */

import { AmbientLight, Color, type IUniform, WebGLRenderer } from 'three';
import {
	type Fur,
	type FurMethod,
	type FurMethodName,
	type FurMethodOptions,
	furMethod,
} from '../../../web/fur/index.ts';
import { loadFur } from '../../../web/measure/studio.ts';
import { Stand } from './Stand.ts';

const SIZE = 120;
const SHELLS = 16;

const renderer = new WebGLRenderer({ antialias: false });

/** What of the GPU is in use: everything that was created and not deleted. */
const objects = { made: 0 };
const gl = renderer.getContext() as WebGL2RenderingContext;
type Call = (...given: unknown[]) => unknown;
const calls = gl as unknown as Record<string, Call>;
for (const kind of ['Texture', 'Buffer', 'Framebuffer', 'Renderbuffer', 'VertexArray', 'Program', 'Shader']) {
	const count = (name: string, step: number) => {
		const call = (calls[name] as Call).bind(gl);
		calls[name] = (...given) => {
			objects.made += given[0] === null ? 0 : step;
			return call(...given);
		};
	};
	count(`create${kind}`, 1);
	count(`delete${kind}`, -1);
}

/** A model of one colour, from root to tip, without its skin in the picture and with a lamp from the left. */
class Rivals extends Stand {
	constructor(readonly fur: Fur) {
		super(renderer, SIZE);
		const { shells, fins, skin } = fur;
		this.lamp.position.set(-1, 0.3, 0.2);
		this.sky.removeFromParent();
		this.scene.add(skin.parent ?? skin);
		this.camera.position.set(0, 3, 9);
		this.camera.lookAt(0, 0, 0);
		if (fins) fins.visible = false;
		shells.shellCount = SHELLS;
		for (const colour of ['root', 'tip', 'tip2'] as const) shells.material[colour] = new Color(1, 1, 1);
		// Only black where it hides the fur behind it.
		skin.traverse((piece) => {
			if ('material' in piece) (piece.material as { color?: Color }).color?.set(0);
		});
	}

	/** @returns what the method shows */
	shoot(method: FurMethod): Float32Array {
		method.apply();
		this.fur.update(0);
		return this.draw();
	}

	override dispose(): void {
		this.fur.dispose();
		super.dispose();
	}
}

const mean = (pixels: Float32Array, wanted: (x: number, y: number) => boolean = () => true) => {
	let [sum, weight] = [0, 0];
	for (let i = 0; i < pixels.length / 4; i++) {
		if (!wanted(i % SIZE, Math.floor(i / SIZE))) continue;
		sum += pixels[i * 4] ?? 0;
		weight += pixels[i * 4 + 3] ?? 0;
	}
	return sum / weight;
};

const apart = (a: Float32Array, b: Float32Array, only?: number) =>
	a.reduce(
		(worst, value, i) =>
			only === undefined || i % 4 === only ? Math.max(worst, Math.abs(value - (b[i] ?? 0))) : worst,
		0,
	);

const uniform = (method: FurMethod, name: string) => method.material.uniforms[name] as IUniform;

export const rivals = {
	/** All methods in turn, and again the first of them: brightness over the fur, and how far they are from the first. */
	async pictures(
		url: string,
		names: readonly FurMethodName[],
	): Promise<{ pictures: { mean: number; apart: number; alphaApart: number }[]; error: number }> {
		const stage = new Rivals(await loadFur(url));
		const shots = names.map((name) => {
			const method = furMethod(stage.fur, name, { renderer });
			const pixels = stage.shoot(method);
			method.dispose();
			return pixels;
		});
		const first = shots[0] as Float32Array;
		const pictures = shots.map((pixels) => ({
			mean: mean(pixels),
			apart: apart(pixels, first),
			alphaApart: apart(pixels, first, 3),
		}));
		stage.dispose();
		return { pictures, error: gl.getError() };
	},

	/** Mean light of the left and the right third under the lamp from the left; of the innermost and of the outermost shell there. */
	async shade(
		url: string,
		options: FurMethodOptions,
	): Promise<{ left: number; right: number; inner: number; outer: number }> {
		const stage = new Rivals(await loadFur(url));
		const method = furMethod(stage.fur, 'shadow-layers', { renderer, ...options });
		const all = stage.shoot(method);
		const left = (x: number) => x < SIZE / 3;
		// The maps stay: nothing is asked to draw them anew.
		const { geometry } = stage.fur.shells;
		const whole = { left: mean(all, left), right: mean(all, (x) => left(SIZE - 1 - x)) };
		stage.fur.skin.visible = false;
		const alone = (shell: number) => {
			uniform(method, 'firstShell').value = shell;
			geometry.instanceCount = 1;
			return mean(stage.draw(), left);
		};
		const shade = { ...whole, inner: alone(0), outer: alone(SHELLS - 1) };
		method.dispose();
		stage.dispose();
		return shade;
	},

	/** What `update` draws, step by step, and whether the same light makes the same picture again. */
	async steps(
		url: string,
	): Promise<{ drew: Record<string, { drawn: boolean; calls: number }>; again: number; moved: number }> {
		const stage = new Rivals(await loadFur(url));
		const { fur, lamp, camera } = stage;
		const method = furMethod(fur, 'shadow-layers', { renderer });
		renderer.info.autoReset = false;
		const drew: Record<string, { drawn: boolean; calls: number }> = {};
		const step = (name: string) => {
			renderer.info.reset();
			const drawn = fur.update(0);
			drew[name] = { drawn, calls: renderer.info.render.calls };
		};
		method.apply();
		step('first');
		const first = stage.draw();
		step('nothing');
		camera.position.x += 0.5;
		stage.draw();
		step('camera');
		camera.position.x -= 0.5;
		lamp.intensity = 3;
		step('intensity');
		lamp.intensity = 6;
		lamp.position.set(-2, 0.6, 0.4);
		step('farther');
		lamp.position.set(0.3, 1, 0.5);
		step('lamp');
		const moved = apart(stage.draw(), first);
		fur.shells.shellCount = 12;
		step('shells');
		const { parent } = fur.shells;
		parent?.position.set(0, 0.1, 0);
		step('model');
		parent?.position.set(0, 0, 0);
		fur.shells.shellCount = SHELLS;
		lamp.position.set(-1, 0.3, 0.2);
		step('back');
		const again = apart(stage.draw(), first);
		renderer.info.autoReset = true;
		method.dispose();
		stage.dispose();
		return { drew, again, moved };
	},

	/** Objects on the GPU after each round in which all methods were drawn and disposed of. */
	async leftOver(
		url: string,
		names: readonly FurMethodName[],
		rounds: number,
	): Promise<{ objects: number[]; own: boolean }> {
		const stage = new Rivals(await loadFur(url));
		const { material } = stage.fur.shells;
		stage.draw();
		let own = true;
		const counts = Array.from({ length: rounds }, () => {
			const methods = names.map((name) => furMethod(stage.fur, name, { renderer }));
			for (const method of methods) stage.shoot(method);
			for (const method of methods.toReversed()) method.dispose();
			own &&= stage.fur.shells.material === material;
			stage.draw();
			return objects.made;
		});
		stage.dispose();
		return { objects: counts, own };
	},

	/** Brightness and largest difference of the same method with other options, or under other lamps of the same sum. */
	async variants(
		url: string,
		name: FurMethodName,
		variants: { options?: FurMethodOptions; lamps?: number; ambient?: number }[],
	): Promise<{ means: number[]; apart: number[]; error: number }> {
		const stage = new Rivals(await loadFur(url));
		const shots = variants.map(({ options = {}, lamps = 1, ambient = 0 }) => {
			const more = Array.from({ length: lamps - 1 }, () => stage.lamp.clone());
			const sky = new AmbientLight(0xffffff, ambient);
			for (const lamp of [stage.lamp, ...more]) lamp.intensity = 6 / lamps;
			stage.scene.add(...more, sky);
			const method = furMethod(stage.fur, name, { renderer, ...options });
			const pixels = stage.shoot(method);
			method.dispose();
			stage.scene.remove(...more, sky);
			return pixels;
		});
		stage.dispose();
		const first = shots[0] as Float32Array;
		return {
			means: shots.map((pixels) => mean(pixels)),
			apart: shots.map((pixels) => apart(pixels, first)),
			error: gl.getError(),
		};
	},
};

export type RivalStage = typeof rivals;
Object.assign(window, { rivals });
