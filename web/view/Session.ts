/** A view's time in the page: what it holds from its coming until it goes, and frees then. */

import { LoadingManager } from 'three';
import type { Picture } from '../scene/Painter.ts';
import { FurPicture, type Shown } from './FurPicture.ts';
import { placeNamed } from './places/places.ts';
import { type Drawn, join, leave, type Shared } from './shared.ts';
import { dress, findPelt, gltfAt, loadBody, plain } from './subject.ts';

/** Margin around the window within which a view begins to load. */
const NEAR = '50%';

/** What a view is to show. */
export interface Wanted {
	src: string;
	preset: string;
}

export class Session implements Drawn {
	readonly picture: FurPicture;
	readonly #canvas: HTMLCanvasElement;
	readonly #shared: Shared;
	readonly #near: IntersectionObserver;
	#shownOn: Picture | undefined;
	#manager: LoadingManager | undefined;
	/** Number of the latest load: what an earlier one brings is too late. */
	#turn = 0;
	/** Number of models that are being compiled. */
	#compiling = 0;

	/**
	 * @param calm whether nothing glides
	 * @param near called once the view is in the window, or nearly
	 */
	constructor(canvas: HTMLCanvasElement, calm: boolean, near: () => void) {
		this.#canvas = canvas;
		this.#shared = join(this);
		this.picture = new FurPicture(this.#shared.backdrop, !calm);
		this.#near = new IntersectionObserver(
			(changes) => {
				if (!changes.some(({ isIntersecting }) => isIntersecting)) return;
				this.#near.disconnect();
				near();
			},
			{ rootMargin: NEAR },
		);
		this.#near.observe(canvas);
	}

	/** False without WebGL2. */
	get works(): boolean {
		return this.#shared.painter.renderer !== undefined;
	}

	/** Cancels what is being loaded, and takes off what is on show. */
	clear(): void {
		this.#turn++;
		this.#manager?.abort();
		this.picture.show(undefined);
	}

	/**
	 * Shows another model, once it is there.
	 *
	 * @param before called before it is drawn
	 * @returns undefined where another was asked for meanwhile; else why it is not in the fur asked for, or '' where it is
	 * @throws Error of one sentence
	 */
	async show({ src, preset }: Wanted, before: () => void): Promise<string | undefined> {
		const turn = ++this.#turn;
		const late = () => turn !== this.#turn;
		this.#manager?.abort();
		this.#manager = new LoadingManager();
		try {
			const { shown, reason } = await this.#load({ src, preset }, this.#manager, late);
			if (late()) {
				shown.dispose();
				return undefined;
			}
			this.picture.show(shown);
			before();
			await this.#compile(shown);
			await this.#shared.painter.drawn(this.#canvas);
			return late() ? undefined : reason;
		} catch (error) {
			if (late()) return undefined;
			throw error;
		}
	}

	/** Compiles what is shown; it is not drawn before. */
	async #compile({ fur }: Shown): Promise<void> {
		const { scene, camera } = this.picture;
		this.#compiling++;
		try {
			await this.#shared.painter.compile(scene, camera, fur ? [fur] : []);
		} finally {
			this.#compiling--;
			this.redraw();
		}
	}

	async #load({ src, preset }: Wanted, manager: LoadingManager, late: () => boolean) {
		const { limits } = this.#shared.painter;
		if (!limits) throw new Error('this browser has no WebGL2');
		const url = gltfAt(src, document.baseURI);
		const model = await loadBody(url, limits, manager);
		let shown: Shown = plain(model);
		let reason = model.fur
			? ''
			: `fur: ${model.newer ? `got version ${model.newer}, newer than this element` : 'got a model without any, expected a baked one'}`;
		try {
			if (preset && !late()) {
				const pelt = await findPelt(preset, url, document.baseURI, manager.abortController.signal);
				shown = await dress(model, pelt, limits, manager);
			}
		} catch (error) {
			reason = `preset: ${(error as Error).message}`;
		}
		return { shown, reason };
	}

	/** Shows a place by its name, or the page's own daylight. @throws Error for a name of none */
	surround(name: string): void {
		this.picture.setPlace(name ? placeNamed(name) : undefined);
		this.redraw();
	}

	/** Requests a frame, with a new picture in it. */
	redraw(): void {
		if (!this.picture.shown || this.#compiling > 0) return;
		this.#shownOn ??= this.#shared.painter.picture(this.#canvas, () => this.#draw());
		this.#shownOn.redraw();
	}

	/** Requests a frame, in which the light may move. */
	wake(): void {
		this.#shared.painter.wake();
	}

	step(elapsed: number): boolean {
		if (!this.#shownOn?.visible || !this.picture.step(elapsed)) return false;
		this.#shownOn.redraw();
		return true;
	}

	#draw(): void {
		const { scene, camera, shown } = this.picture;
		if (!shown || this.#compiling > 0) return;
		const { width, height } = this.#canvas;
		this.picture.fit(width / height);
		this.picture.lamp.glide(camera, Number.POSITIVE_INFINITY);
		this.#shared.painter.render(scene, camera, this.#canvas);
	}

	/** Frees everything. */
	dispose(): void {
		this.#near.disconnect();
		this.clear();
		this.#shownOn?.remove();
		this.picture.clear();
		this.#shared.painter.forget(this.picture.scene);
		leave(this);
		// The canvas's own pixels.
		Object.assign(this.#canvas, { width: 0, height: 0 });
	}
}
