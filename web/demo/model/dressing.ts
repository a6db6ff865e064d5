/** The fur of the model on show: pelts and methods, their states and finer planes, as the view asks for them. */

import { compileMotion, compileScene, compilesAside } from '../../scene/compile.ts';
import { notice } from '../say/notice.ts';
import type { Crowd } from '../stage/crowd.ts';
import type { Picture } from '../stage/picture.ts';
import type { Store } from '../state/store.ts';
import type { View } from '../state/view.ts';
import { words } from '../words/index.ts';
import { adjust, standsAlone } from './adjust.ts';
import type { Dynamics } from './dynamics.ts';
import { wantsFine } from './finePlanes.ts';
import type { Looks } from './looks.ts';
import type { MenuEntry } from './menu.ts';
import { availableOutfits, type DressTarget, fineOutfits } from './outfits.ts';

/** The model on show, as far as the list of models knows it. */
export interface OnShow {
	readonly menu: readonly MenuEntry[];
	readonly entry: MenuEntry | undefined;
	/** Called when other fur is on show. */
	changed(): void;
}

export class Dressing {
	readonly #picture: Picture;
	readonly #store: Store;
	readonly #looks: Looks;
	readonly #dynamics: Dynamics;
	readonly #onShow: OnShow;
	#latest = 0;
	#Crowd: typeof Crowd | undefined;
	/** True once the states of the furs on show were asked for, and have not failed. */
	#hasStates = false;

	constructor(picture: Picture, store: Store, looks: Looks, dynamics: Dynamics, onShow: OnShow) {
		this.#picture = picture;
		this.#store = store;
		this.#looks = looks;
		this.#dynamics = dynamics;
		this.#onShow = onShow;
	}

	/** Styles hairs, weather, crowd and lamps by the view. @returns true if that needs what `dress` fetches */
	style(): boolean {
		const { stage } = this.#picture;
		const view = this.#store.get();
		this.#looks.style(view);
		this.#dynamics.style(view);
		stage.setCrowd(view.crowd ?? 1, this.#looks.fur, this.#Crowd);
		stage.lamps = view.lights ?? 1;
		stage.exposure = view.exposure ?? 1;
		this.#picture.request();
		return (!this.#hasStates && this.#dynamics.needsStates(view)) || this.#lacks(view);
	}

	/** True for a view that needs modules that are not loaded. */
	#lacks(view: View): boolean {
		return ((view.crowd ?? 1) > 1 && !this.#Crowd) || this.#dynamics.lacksMotion(view);
	}

	/** Loads the modules that a view needs; what cannot be had is left out until it is asked for again. */
	async #load(view: View): Promise<void> {
		if (this.#dynamics.lacksMotion(view)) await this.#dynamics.loadMotion();
		if ((view.crowd ?? 1) > 1) this.#Crowd = (await import('../stage/crowd.ts').catch(() => undefined))?.Crowd;
	}

	/** Dresses the model by the view. @param first the first fur of all shows at once, and whole a frame later */
	async dress(first = false): Promise<void> {
		const turn = ++this.#latest;
		const { stage } = this.#picture;
		const { model } = stage;
		if (!model?.fur) return this.#onShow.changed();
		const late = () => turn !== this.#latest || model !== stage.model;
		const { menu, entry } = this.#onShow;
		const { view, reasons } = adjust(this.#store.get(), entry, menu, standsAlone(model.fur));
		this.#store.change(view);
		for (const reason of reasons) notice(reason(words));
		const withStates = this.#dynamics.needsStates(view);
		this.#hasStates = withStates;
		const target: DressTarget = { body: model.fur, withStates, entry, limits: stage.limits };
		const { outfits, without } = await availableOutfits(view, menu, target);
		if (late()) return;
		if (without) this.#store.change(without);
		if (this.#lacks(view)) await this.#load(view);
		const wanted = wantsFine(view.planes);
		const fine = wanted ? await fineOutfits(this.#store.get(), menu, target, false) : undefined;
		if (late()) return;
		this.#looks.show(model.fur, fine ?? outfits, this.#store.get());
		await this.#show(first);
		const loaded = !withStates || (await this.#dynamics.load());
		if (late()) return;
		if (!loaded) this.#store.change({ wet: undefined, dirt: undefined });
		// Retry on the next change after a failure.
		this.#hasStates = withStates && !without && loaded;
		this.#dynamics.style(this.#store.get());
		this.#picture.reportTextureMemory();
		this.#onShow.changed();
		const refined = wanted && !fine ? this.#refine(target, late) : undefined;
		// Last of all: while they are compiled, the first use of any other shader waits for them.
		if (first || refined) void Promise.resolve(refined).then(() => late() || this.#compileMotion());
		// Planes that were asked for by name belong to the whole picture.
		if (view.planes === '128') await refined;
	}

	/** Shows the fur that the body has been dressed in. */
	async #show(first: boolean): Promise<void> {
		const picture = this.#picture;
		this.#looks.setSplit(picture.columnOf(this.#store.get().split?.share ?? 1));
		this.style();
		picture.updateLight();
		picture.fit();
		await picture.frames.hold(this.#compile());
		if (!first) return;
		await this.#looks.showFirst(this.#store, () => picture.drawn());
		performance.mark('furbake:fur');
		// Ready for the first wind or hand.
		void this.#dynamics.loadMotion();
	}

	/** Compiles the fur as it will be drawn, swinging where the body moves. */
	async #compile(): Promise<void> {
		const { stage, camera } = this.#picture;
		const { renderer, scene, sample } = stage;
		if (!compilesAside(renderer)) return;
		await this.#dynamics.prepare();
		// A first step wakes hairs that lag behind the body.
		this.#picture.animate(1 / 60);
		await compileScene(renderer, scene, camera, sample, this.#looks.furs);
	}

	/** Compiles aside what the furs on show need once they swing, or rest. */
	#compileMotion(): void {
		const { stage, camera } = this.#picture;
		compileMotion(stage.renderer, stage.scene, camera, stage.sample, this.#looks.furs);
	}

	/** Fades over to finer planes; the fur stays as it is where they cannot be had. */
	async #refine(target: DressTarget, late: () => boolean): Promise<void> {
		try {
			const [outfits, { refine }] = await Promise.all([
				fineOutfits(this.#store.get(), this.#onShow.menu, target, true),
				import('./refine.ts'),
			]);
			if (!outfits || late() || !(await refine(this.#picture, this.#looks, outfits, this.#store, late))) return;
			this.#picture.reportTextureMemory();
			this.#onShow.changed();
		} catch (error) {
			if (!late() && this.#store.get().planes === '128')
				notice(words.planesNotShown((error as Error).message), 'error');
		}
	}
}
