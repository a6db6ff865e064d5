/** Bench of methods: one view, one clock, turns there and back. */

import {
	Color,
	ConstantColorFactor,
	FloatType,
	HalfFloatType,
	Material,
	Mesh,
	PerspectiveCamera,
	WebGLRenderer,
	WebGLRenderTarget,
	ZeroFactor,
} from 'three';
import { perRound, thereAndBack } from '../statistics.ts';
import { breath, Stopwatch } from '../stopwatch.ts';
import { renderFloats } from '../studio.ts';
import type { Overdraw } from './results.ts';
import type { Subject } from './subjects.ts';

/** Camera: the whole ring, seen from above its horizon, fills the picture's height. Degrees, model units. */
const FIELD_OF_VIEW = 20;
const PLACE = [0, 3.9, 4.85] as const;
const [NEAR, FAR] = [1, 20];

/** Factor of a fragment on the picture when counting: 0.9⁸⁰⁰ is still a float. */
const SHARE = 0.9;
const WARM_UP = 2; // frames

/** Progress of a comparison. @param done turns of all @param total */
export type Progress = (done: number, total: number) => void;

export class Comparison {
	readonly renderer = new WebGLRenderer({ antialias: false, powerPreference: 'high-performance' });
	readonly stopwatch: Stopwatch;
	readonly #camera = new PerspectiveCamera(FIELD_OF_VIEW);
	readonly #targets = new Map<string, WebGLRenderTarget>();
	/** Number of frames drawn, by which lamps move. */
	#step = 0;

	constructor() {
		this.stopwatch = new Stopwatch(this.renderer);
		// Affects only lamps that cast shadows.
		this.renderer.shadowMap.enabled = true;
	}

	/** Draw one frame of a subject and leave its target bound. */
	#draw(subject: Subject): void {
		const target = this.#target(subject);
		subject.turn(this.#step++);
		subject.prepare();
		this.renderer.setRenderTarget(target);
		this.renderer.render(subject.scene, this.#see(subject, target));
	}

	/** Camera on a subject, for a picture of this size. */
	#see({ reach }: Subject, { width, height }: { width: number; height: number }): PerspectiveCamera {
		const camera = this.#camera;
		camera.aspect = width / height;
		[camera.near, camera.far] = [NEAR, FAR * reach];
		camera.updateProjectionMatrix();
		camera.position.set(...PLACE).multiplyScalar(reach);
		camera.lookAt(0, 0, 0);
		return camera;
	}

	/** Half floats, as in the demo. */
	#target({ row: { width, height } }: Subject): WebGLRenderTarget {
		const size = `${width}x${height}`;
		const target = this.#targets.get(size) ?? new WebGLRenderTarget(width, height, { type: HalfFloatType });
		this.#targets.set(size, target);
		return target;
	}

	/**
	 * Times subjects in turn, group by group and round by round.
	 *
	 * @param groups subjects of a group are compared, so their turns follow each other closely
	 * @returns time of every subject in every round, milliseconds a frame
	 */
	async timeInTurn(
		groups: readonly (readonly Subject[])[],
		rounds: number,
		signal: AbortSignal,
		progress: Progress,
	): Promise<Map<Subject, number[]>> {
		const subjects = groups.flat();
		const total = subjects.length * (WARM_UP + 2 * rounds);
		const frames = new Map<Subject, number>();
		const turns = new Map<Subject, number[]>(subjects.map((subject) => [subject, []]));
		let done = 0;
		const turn = async (subject: Subject) => {
			await breath();
			signal.throwIfAborted();
			const time = await this.stopwatch.time(
				() => this.#draw(subject),
				frames.get(subject) ?? 1,
				this.#target(subject),
			);
			progress(++done, total);
			return time;
		};
		for (const subject of subjects) {
			for (let i = 0; i < WARM_UP; i++) {
				const time = await turn(subject);
				// Skip the first frame, which compiles and uploads.
				if (i > 0) frames.set(subject, Stopwatch.framesFor(time));
			}
		}
		for (let round = 0; round < rounds; round++) {
			for (const group of groups) {
				for (const subject of thereAndBack(group)) turns.get(subject)?.push(await turn(subject));
			}
		}
		return new Map(subjects.map((subject) => [subject, perRound(turns.get(subject) ?? [])]));
	}

	/** Fragments per covered pixel; null where floats cannot be blended. */
	overdraw(subject: Subject): Overdraw | null {
		if (!this.renderer.extensions.get('EXT_float_blend')) return null;
		const shaded = this.#count(subject, true);
		const blended = this.#count(subject, false);
		const sum = (counts: Float32Array) => counts.reduce((total, count) => total + count, 0);
		const reached = shaded.reduce((pixels, count) => pixels + (count > 0 ? 1 : 0), 0);
		return { covered: reached / shaded.length, shaded: sum(shaded) / reached, blended: sum(blended) / reached };
	}

	/**
	 * Count fragments of fur in every pixel, by blending, whatever the shader writes: every fragment multiplies the pixel by
	 * the same constant.
	 *
	 * @param all whether to count fragments that the alpha cut drops or other fur hides
	 */
	#count(subject: Subject, all: boolean): Float32Array {
		const { width, height } = subject.row;
		const undo: (() => void)[] = [];
		const change = (what: object, values: Record<string, unknown>) => {
			const own = what as Record<string, unknown>;
			const kept = Object.fromEntries(Object.keys(values).map((name) => [name, own[name]]));
			undo.push(() => Object.assign(what, kept));
			Object.assign(what, values);
		};
		subject.scene.traverse((object) => {
			if (!(object instanceof Mesh && object.material instanceof Material)) return;
			const { material } = object;
			if (!material.transparent) return change(material, { colorWrite: false });
			const blendColor = new Color().setScalar(SHARE);
			change(material, { blendSrc: ZeroFactor, blendDst: ConstantColorFactor, blendColor, blendAlpha: SHARE });
			if (!all) return;
			change(material, { depthWrite: false });
			if (!('alphaCut' in material)) return;
			// Shells would set the alpha cut for the picture.
			change(object, { onBeforeRender() {} });
			change(material, { alphaCut: 0 });
		});
		const target = new WebGLRenderTarget(width, height, { type: FloatType });
		subject.prepare();
		const picture = renderFloats(this.renderer, subject.scene, this.#see(subject, target), target, 1);
		target.dispose();
		for (const step of undo.reverse()) step();
		return Float32Array.from({ length: width * height }, (_, i) =>
			Math.round(Math.log(picture[4 * i] ?? 1) / Math.log(SHARE)),
		);
	}

	/** Picture of a subject over nothing, rgba, linear, premultiplied; row by row from the bottom. */
	picture(subject: Subject, width: number, height: number): Float32Array {
		const target = new WebGLRenderTarget(width, height, { type: FloatType });
		subject.turn(0);
		subject.prepare();
		const picture = renderFloats(this.renderer, subject.scene, this.#see(subject, target), target);
		target.dispose();
		return picture;
	}

	dispose(): void {
		for (const target of this.#targets.values()) target.dispose();
		this.renderer.dispose();
		this.renderer.forceContextLoss();
	}
}
