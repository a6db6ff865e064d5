/** Where rivals meet: one view, one clock, turns there and back. */

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
import type { Overdraw } from './results.ts';
import type { Rival } from './rivals.ts';
import { perRound, thereAndBack } from './statistics.ts';
import { breath, Stopwatch } from './stopwatch.ts';
import { renderFloats } from './studio.ts';

/** Of the camera: the whole ring, seen from above its horizon, fills the picture's height. Degrees, model units. */
const FIELD_OF_VIEW = 20;
const PLACE = [0, 3.9, 4.85] as const;

/** What each fragment multiplies the picture by where fragments are counted: 0.9⁸⁰⁰ is still a float. */
const SHARE = 0.9;
const WARM_UP = 2; // frames

/** What a contest tells while it goes on. @param done turns of all @param total */
export type Progress = (done: number, total: number) => void;

export class Arena {
	readonly renderer = new WebGLRenderer({ antialias: false, powerPreference: 'high-performance' });
	readonly stopwatch: Stopwatch;
	readonly #camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 1, 20);
	readonly #targets = new Map<string, WebGLRenderTarget>();
	/** Frames that have been drawn: lamps move on with it. */
	#step = 0;

	constructor() {
		this.stopwatch = new Stopwatch(this.renderer);
		// Only lamps that cast shadows make a difference.
		this.renderer.shadowMap.enabled = true;
	}

	/** Draws one frame of a rival, and leaves its target bound. */
	#draw(rival: Rival): void {
		const target = this.#target(rival);
		rival.turn(this.#step++);
		rival.prepare(this.renderer);
		this.renderer.setRenderTarget(target);
		this.renderer.render(rival.scene, this.#see(target));
	}

	#see({ width, height }: { width: number; height: number }): PerspectiveCamera {
		const camera = this.#camera;
		if (camera.aspect !== width / height) {
			camera.aspect = width / height;
			camera.updateProjectionMatrix();
		}
		camera.position.set(...PLACE);
		camera.lookAt(0, 0, 0);
		return camera;
	}

	/** As deep as what the demo's frames are blended in. */
	#target({ row: { width, height } }: Rival): WebGLRenderTarget {
		const size = `${width}x${height}`;
		const target = this.#targets.get(size) ?? new WebGLRenderTarget(width, height, { type: HalfFloatType });
		this.#targets.set(size, target);
		return target;
	}

	/**
	 * Rivals take turns, group by group and round by round.
	 *
	 * @param groups those of a group are compared, so their turns follow each other closely
	 * @returns of every rival its time in every round, milliseconds a frame
	 */
	async contest(
		groups: readonly (readonly Rival[])[],
		rounds: number,
		signal: AbortSignal,
		progress: Progress,
	): Promise<Map<Rival, number[]>> {
		const rivals = groups.flat();
		const total = rivals.length * (WARM_UP + 2 * rounds);
		const frames = new Map<Rival, number>();
		const turns = new Map<Rival, number[]>(rivals.map((rival) => [rival, []]));
		let done = 0;
		const turn = async (rival: Rival) => {
			await breath();
			signal.throwIfAborted();
			const time = await this.stopwatch.time(() => this.#draw(rival), frames.get(rival) ?? 1, this.#target(rival));
			progress(++done, total);
			return time;
		};
		for (const rival of rivals) {
			for (let i = 0; i < WARM_UP; i++) {
				const time = await turn(rival);
				// The first frame compiles and uploads.
				if (i > 0) frames.set(rival, Stopwatch.framesFor(time));
			}
		}
		for (let round = 0; round < rounds; round++) {
			for (const group of groups) {
				for (const rival of thereAndBack(group)) turns.get(rival)?.push(await turn(rival));
			}
		}
		return new Map(rivals.map((rival) => [rival, perRound(turns.get(rival) ?? [])]));
	}

	/** Fragments per pixel that fur covers; null where floats cannot be blended. */
	overdraw(rival: Rival): Overdraw | null {
		if (!this.renderer.extensions.get('EXT_float_blend')) return null;
		const shaded = this.#count(rival, true);
		const blended = this.#count(rival, false);
		const sum = (counts: Float32Array) => counts.reduce((total, count) => total + count, 0);
		const reached = shaded.reduce((pixels, count) => pixels + (count > 0 ? 1 : 0), 0);
		return { covered: reached / shaded.length, shaded: sum(shaded) / reached, blended: sum(blended) / reached };
	}

	/**
	 * Fragments of fur in every pixel. Blending itself counts, whatever the shader writes: every fragment multiplies what
	 * is there by the same constant.
	 *
	 * @param all of them, or those alone that neither the alpha cut drops nor other fur hides
	 */
	#count(rival: Rival, all: boolean): Float32Array {
		const { width, height } = rival.row;
		const undo: (() => void)[] = [];
		const change = (what: object, values: Record<string, unknown>) => {
			const own = what as Record<string, unknown>;
			const kept = Object.fromEntries(Object.keys(values).map((name) => [name, own[name]]));
			undo.push(() => Object.assign(what, kept));
			Object.assign(what, values);
		};
		rival.scene.traverse((object) => {
			if (!(object instanceof Mesh && object.material instanceof Material)) return;
			const { material } = object;
			if (!material.transparent) return change(material, { colorWrite: false });
			const blendColor = new Color().setScalar(SHARE);
			change(material, { blendSrc: ZeroFactor, blendDst: ConstantColorFactor, blendColor, blendAlpha: SHARE });
			if (!all) return;
			change(material, { depthWrite: false });
			if (!('alphaCut' in material)) return;
			// Shells would set it for the picture.
			change(object, { onBeforeRender() {} });
			change(material, { alphaCut: 0 });
		});
		const target = new WebGLRenderTarget(width, height, { type: FloatType });
		rival.prepare(this.renderer);
		const picture = renderFloats(this.renderer, rival.scene, this.#see(target), target, 1);
		target.dispose();
		for (const step of undo.reverse()) step();
		return Float32Array.from({ length: width * height }, (_, i) =>
			Math.round(Math.log(picture[4 * i] ?? 1) / Math.log(SHARE)),
		);
	}

	/** The rival's picture over nothing, rgba, linear, premultiplied; row by row from the bottom. */
	picture(rival: Rival, width: number, height: number): Float32Array {
		const target = new WebGLRenderTarget(width, height, { type: FloatType });
		rival.turn(0);
		rival.prepare(this.renderer);
		const picture = renderFloats(this.renderer, rival.scene, this.#see(target), target);
		target.dispose();
		return picture;
	}

	dispose(): void {
		for (const target of this.#targets.values()) target.dispose();
		this.renderer.dispose();
		this.renderer.forceContextLoss();
	}
}
