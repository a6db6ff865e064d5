import {
	DataTexture,
	FloatType,
	type IUniform,
	NearestFilter,
	type PixelFormat,
	RGBAFormat,
	RGFormat,
	type Texture,
	Vector4,
	type WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import { FOLLICLES_PER_ROW } from '../body/FurFollicles.ts';
import type { Joints } from '../body/joints/joints.ts';
import { STEPS } from './Blend.ts';
import { calm, type Drive, GUST, JOINT, LEE, STRENGTHS, VEER, WAVES } from './drive.ts';
import type { Roots } from './roots.ts';
import type { Strokes } from './Strokes.ts';
import showFragment from './shaders/show.frag.glsl?raw';
import stepFragment from './shaders/springs.frag.glsl?raw';
import { type Solver, type SpringStates, STATE } from './solver.ts';
import { LIMIT, type Spring } from './spring.ts';
import { TexelPass } from './TexelPass.ts';

const float = (value: number) => value.toFixed(6);

const DEFINES = {
	ROW: FOLLICLES_PER_ROW,
	JOINT: JOINT / 4,
	STEPS,
	WAVES,
	LIMIT: float(LIMIT),
	LEE: float(LEE),
	GUST: float(GUST),
	VEER: float(VEER),
	...Object.fromEntries(STRENGTHS.map((strength, w) => [`STRENGTH${w}`, float(strength)])),
};

const options = { type: FloatType, depthBuffer: false, magFilter: NearestFilter, minFilter: NearestFilter } as const;

/**
 * Springs of `CpuSprings` on the GPU, a texel per follicle. Two targets hold the states in turn; a sub-step is one pass over
 * their texels. After a lost context all hairs are at rest.
 */
export class GpuSprings implements Solver {
	readonly #renderer: WebGLRenderer;
	readonly #strokes: Strokes;
	readonly #step: TexelPass;
	readonly #show: TexelPass;
	readonly #targets: readonly [WebGLRenderTarget, WebGLRenderTarget];
	readonly #shown: WebGLRenderTarget;
	/** SpringStates from the CPU: displacements before, displacements and velocities after the last sub-step. */
	readonly #given: readonly [DataTexture, DataTexture, DataTexture];
	readonly #offsets: DataTexture;
	/** Joints of the last drive. */
	readonly #motions: DataTexture;
	/** Ways of morph targets of the last drive that has any. */
	readonly #ways: DataTexture;
	readonly #tables: DataTexture[];
	/** Version of the uploaded stroke offsets. */
	#version = -1;
	/** Next target to draw to. */
	#next: 0 | 1 = 0;
	#lost = false;
	/** Free objects of a lost context while it is lost: later three would ask the next context to delete them. */
	readonly #lose = () => {
		this.#free();
		this.#lost = true;
	};

	/** Whether a GPU can draw to such targets and fits all follicles. */
	static suits({ extensions, capabilities }: WebGLRenderer, { follicles, joints }: Roots): boolean {
		const texels = Math.max(follicles.links.length, 4 * follicles.count, (JOINT / 4) * joints.bones.length);
		const rows = Math.ceil(texels / FOLLICLES_PER_ROW);
		return extensions.has('EXT_color_buffer_float') && rows <= capabilities.maxTextureSize;
	}

	/** @param states initial states; @param ways `Drive.ways` */
	constructor(
		renderer: WebGLRenderer,
		roots: Roots,
		spring: Spring,
		strokes: Strokes,
		states: SpringStates,
		ways: Float32Array,
	) {
		const { count } = roots.follicles;
		const rows = Math.ceil(count / FOLLICLES_PER_ROW);
		this.#renderer = renderer;
		this.#strokes = strokes;
		this.#offsets = texture(strokes.offsets, RGBAFormat);
		const tables = tablesOf(roots);
		this.#tables = Object.values(tables);
		this.#motions = texture(calm(roots.joints.bones.length).joints, RGBAFormat);
		this.#ways = ways.length > 0 ? texture(ways.slice(), RGBAFormat) : table(1, 4, () => 0);
		const given = (from: Float32Array, part: number) =>
			table(count, 4, (i, c) => (c < 3 ? (from[STATE * i + part + c] as number) : 0));
		this.#given = [given(states.before, 0), given(states.after, 0), given(states.after, 3)];
		const [before, after, velocities] = this.#given;
		const { xx, xv, vx, vv, fastest } = spring;
		this.#step = new TexelPass(
			'FurSprings',
			stepFragment,
			{
				count: { value: count },
				...Object.fromEntries(Object.entries(tables).map(([name, value]) => [name, { value }])),
				joints: { value: this.#motions },
				ways: { value: this.#ways },
				morphs: { value: false },
				offsets: { value: this.#offsets },
				displacements: { value: after },
				velocities: { value: velocities },
				spring: { value: new Vector4(xx, xv, vx, vv) },
				fastest: { value: fastest },
				pull: { value: null },
				laid: { value: null },
				blow: { value: null },
				gale: { value: 0 },
				gusts: { value: 0 },
				waves: { value: null },
				fade: { value: 1 },
			},
			DEFINES,
		);
		this.#show = new TexelPass('FurSwing', showFragment, {
			before: { value: before },
			after: { value: after },
			share: { value: 1 },
		});
		const target = () => new WebGLRenderTarget(FOLLICLES_PER_ROW, rows, { ...options, count: 2 });
		this.#targets = [target(), target()];
		this.#shown = new WebGLRenderTarget(FOLLICLES_PER_ROW, rows, options);
		this.#shown.texture.name = 'swing';
		renderer.domElement.addEventListener('webglcontextlost', this.#lose);
	}

	get swing(): Texture {
		return this.#shown.texture;
	}

	/** Whether the states were lost with their context. */
	get lost(): boolean {
		return this.#lost;
	}

	step(drive: Drive): void {
		const { uniforms } = this.#step;
		if (this.#version !== this.#strokes.version) {
			this.#version = this.#strokes.version;
			this.#offsets.needsUpdate = true;
		}
		(this.#motions.image.data as Float32Array).set(drive.joints);
		this.#motions.needsUpdate = true;
		if (drive.morphs) {
			(this.#ways.image.data as Float32Array).set(drive.ways);
			this.#ways.needsUpdate = true;
		}
		const target = this.#targets[this.#next];
		for (const name of NAMES) (uniforms[name] as IUniform).value = drive[name];
		this.#step.draw(this.#renderer, target);
		const [displacements, velocities] = target.textures as [Texture, Texture];
		this.#read((uniforms.displacements as IUniform).value, displacements, velocities);
		this.#next = this.#next === 0 ? 1 : 0;
	}

	/** Set the states to read. */
	#read(before: Texture, after: Texture, velocities: Texture): void {
		const { uniforms } = this.#step;
		(uniforms.displacements as IUniform).value = after;
		(uniforms.velocities as IUniform).value = velocities;
		(this.#show.uniforms.before as IUniform).value = before;
		(this.#show.uniforms.after as IUniform).value = after;
	}

	show(share: number): void {
		(this.#show.uniforms.share as IUniform).value = share;
		this.#show.draw(this.#renderer, this.#shown);
		// Signals a change to listeners on the version.
		this.swing.version++;
	}

	/** Runs sub-steps from the given states, waits for them and discards the result. */
	rehearse(drive: Drive, steps: number): void {
		for (let i = 0; i < steps; i++) this.step(drive);
		this.show(1);
		this.#renderer.readRenderTargetPixels(this.#shown, 0, 0, 1, 1, new Float32Array(4));
		this.#read(...this.#given);
	}

	rest(): void {
		for (const texture of this.#given) {
			(texture.image.data as Float32Array).fill(0);
			texture.needsUpdate = true;
		}
		this.#lost = false;
		this.#read(...this.#given);
	}

	dispose(): void {
		this.#renderer.domElement.removeEventListener('webglcontextlost', this.#lose);
		this.#free();
		// Notifies furs that use it.
		this.swing.dispose();
	}

	#free(): void {
		for (const pass of [this.#step, this.#show]) pass.dispose();
		for (const target of [...this.#targets, this.#shown]) target.dispose();
		for (const table of [...this.#tables, ...this.#given, this.#offsets, this.#motions, this.#ways]) table.dispose();
	}
}

/** Uniforms copied from the drive. */
const NAMES = ['pull', 'laid', 'blow', 'gale', 'gusts', 'waves', 'morphs', 'fade'] as const satisfies (keyof Drive)[];

/** Tables that do not change, by their names in the shader. */
function tablesOf({ follicles, joints, comb, weights }: Roots): Record<string, DataTexture> {
	const { count, position, normal, length, first, links } = follicles;
	const neighbours = (i: number) => (first[i + 1] as number) - (first[i] as number);
	return {
		places: table(count, 4, (i, c) => (c < 3 ? position[3 * i + c] : length[i]) as number),
		normals: table(count, 4, (i, c) => (c < 3 ? normal[3 * i + c] : first[i]) as number),
		combs: table(count, 4, (i, c) => (c < 3 ? (comb[3 * i + c] as number) : neighbours(i))),
		links: table(links.length, 2, (i, c) => (c === 0 ? links[i] : weights[i]) as number),
		carriers: table(4 * count, 2, carrierOf(joints)),
	};
}

/** Joint of each of a follicle's four carriers, and its weight. */
function carrierOf({ first, joints, weights }: Joints): (carrier: number, channel: number) => number {
	let run = 0;
	return (carrier, channel) => {
		while (carrier >= 4 * (first[run + 1] as number)) run++;
		const at = 4 * run + (carrier % 4);
		return (channel === 0 ? joints[at] : weights[at]) as number;
	};
}

/** Texture with a texel of numbers per follicle. */
function table(count: number, size: 2 | 4, value: (i: number, channel: number) => number): DataTexture {
	const values = new Float32Array(size * FOLLICLES_PER_ROW * Math.ceil(count / FOLLICLES_PER_ROW));
	for (let i = 0; i < count; i++) for (let c = 0; c < size; c++) values[size * i + c] = value(i, c);
	return texture(values, size === 4 ? RGBAFormat : RGFormat);
}

function texture(values: Float32Array, format: PixelFormat): DataTexture {
	const rows = values.length / (format === RGBAFormat ? 4 : 2) / FOLLICLES_PER_ROW;
	const made = new DataTexture(values, FOLLICLES_PER_ROW, rows, format, FloatType);
	made.needsUpdate = true;
	return made;
}
