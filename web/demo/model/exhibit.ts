/** The model on show, in its fur and its environment, as the view asks for them. */

import { FUR_VERSION } from '../../fur/index.ts';
import { facing } from '../../measure/facing.ts';
import type { Relit } from '../../rti/relit.ts';
import { compileScene } from '../../scene/compile.ts';
import { loadModel, sourceAt } from '../../scene/load.ts';
import type { Model } from '../../scene/model.ts';
import type { OwnModel } from '../open/drop.ts';
import { notice, withdraw } from '../say/notice.ts';
import type { Progress } from '../say/progress.ts';
import type { Picture } from '../stage/picture.ts';
import type { Store } from '../state/store.ts';
import type { EnvironmentName, Triple, View } from '../state/view.ts';
import { en } from '../words/drop.en.ts';
import { zh } from '../words/drop.zh.ts';
import { language, words } from '../words/index.ts';
import { Dressing } from './dressing.ts';
import { Dynamics } from './dynamics.ts';
import { Looks } from './looks.ts';
import { firstView, folderOf, loadMenu, type MenuEntry, offered } from './menu.ts';
import { Pending } from './pending.ts';
import { Surroundings } from './surroundings.ts';

const dropWords = { en, zh }[language];

export class Exhibit {
	menu: MenuEntry[] = [];
	/** Name or address of the model on show, with a slash in front for a visitor's own; '' for none. */
	shown = '';
	/** True for a visitor's own model, which no link can name. */
	own = false;
	readonly looks: Looks;
	readonly dynamics: Dynamics;
	/** Called when something else is on show, or what was asked for has failed. */
	changed: () => void = () => {};
	readonly #picture: Picture;
	readonly #store: Store;
	readonly #progress: Progress;
	readonly #pending: Pending;
	readonly #surroundings: Surroundings;
	readonly #dressing: Dressing;
	#latest = 0;
	/** Azimuth of the face of the model on show, radians. */
	#front = 0;

	/** @param store of the view that is asked for; what cannot be had is taken out of it */
	constructor(picture: Picture, store: Store, progress: Progress) {
		this.#picture = picture;
		this.#store = store;
		this.#progress = progress;
		this.#pending = new Pending(picture);
		this.#surroundings = new Surroundings(picture.stage);
		const { renderer, key } = picture.stage;
		this.looks = new Looks({ renderer, light: key });
		this.dynamics = new Dynamics(this.looks, picture.stage, picture.calm);
		this.#dressing = new Dressing(picture, store, this.looks, this.dynamics, this);
	}

	get entry(): MenuEntry | undefined {
		return this.menu.find(({ name }) => name === this.shown);
	}

	/** Title of the model on show; undefined for none. */
	get title(): string | undefined {
		const { entry, shown } = this;
		return entry ? (words.titles[entry.name] ?? entry.title) : shown.replace(/^\//, '') || undefined;
	}

	/** Name of the environment on show. */
	get environment(): EnvironmentName | 'none' {
		return this.#surroundings.name;
	}

	/** Opens with what the view asks for. */
	async open(): Promise<void> {
		const view = this.#store.get();
		try {
			this.menu = await loadMenu();
		} catch (error) {
			notice((error as Error).message, 'error');
		}
		const first = this.menu[0]?.name ?? '';
		let name = view.model ?? first;
		if (!folderOf(name, this.menu, document.baseURI) && first) {
			const names = offered(this.menu).map((item) => item.name);
			notice(words.wrongModel(name, names.join(', '), first));
			this.#store.change({ model: undefined });
			name = first;
		}
		this.changed();
		const { camera } = this.#picture;
		if (view.camera) camera.chosen = true;
		camera.target = view.target;
		camera.orbit = view.camera ?? firstView(undefined).camera;
		await this.change(async () => {
			// Without a list of models, and none in the address, there is none to show.
			await Promise.all([this.#surround(view.env ?? 'none'), name && this.#show(name)]);
			// The first picture does without them.
			const lines = await import('../../page/lamp/lines.ts').catch(() => undefined);
			if (lines) this.#picture.lamp.addLines(new lines.LampLines());
			this.#picture.request();
		});
	}

	/** Shows another model; the view names it once it is on show. */
	async show(name: string): Promise<void> {
		await this.change(() => this.#show(name));
		if (this.shown === name) this.#store.change({ model: name });
	}

	/** Shows a visitor's own model, which has no address. */
	receive(own: OwnModel): Promise<void> {
		return this.change(() => this.#show(own.name, own));
	}

	/** Changes the environment; the view names it once its light falls on the model. */
	async surround(name: EnvironmentName | 'none'): Promise<void> {
		await this.change(() => this.#surround(name));
		if (this.environment === name) this.#store.change({ env: name === 'none' ? undefined : name });
	}

	/** Dresses the model by the view. */
	dress(): Promise<void> {
		return this.change(() => this.#dressing.dress());
	}

	/** Styles what is on show by the view. @returns when that can be seen */
	style(): Promise<void> {
		return this.#dressing.style() ? this.dress() : Promise.resolve();
	}

	/** Puts light and camera as they are before a visitor has touched them. */
	aim(): void {
		const picture = this.#picture;
		const { camera, light, target } = this.#store.get();
		picture.camera.target = target;
		if (!picture.camera.chosen) picture.camera.orbit = camera ?? this.#firstCamera();
		picture.setLight(light ?? this.#firstLight(), !light);
		picture.fit();
	}

	/** Values of clips before a visitor chooses: the first one plays, or is held where nothing moves by itself. */
	get firstClip(): Partial<View> {
		const held = this.#picture.calm && this.#picture.stage.model?.clips;
		return { clip: undefined, time: held ? 0 : undefined };
	}

	/** Runs a change that may take long; the page is loading meanwhile. */
	change(what: () => Promise<void>): Promise<void> {
		return this.#pending.run(what);
	}

	/** Reports the page's state once everything is on show. */
	settle(): Promise<void> {
		return this.#pending.settle();
	}

	/** Moves hairs, body and fades on. @returns milliseconds until another frame is wanted: 0 at once, Infinity none */
	step(seconds: number): number {
		return Math.min(this.dynamics.step(seconds), this.looks.step(seconds));
	}

	#firstLight(): Triple {
		const { first } = this.#picture.stage.model ?? {};
		return first?.light ?? this.#surroundings.sun ?? firstView(this.entry, 1, this.#front).light;
	}

	#firstCamera(): Triple {
		const { first } = this.#picture.stage.model ?? {};
		return first?.camera ?? firstView(this.entry, this.#store.get().crowd, this.#front).camera;
	}

	/** Changes the environment; says why and keeps the one before where that fails. */
	async #surround(name: EnvironmentName | 'none'): Promise<void> {
		const picture = this.#picture;
		try {
			if (!(await this.#surroundings.change(name))) return;
			if (picture.stage.model && !this.#store.get().light) picture.light.put(this.#firstLight(), true);
			picture.updateLight();
			picture.reportTextureMemory();
		} catch (error) {
			const { environment } = this;
			this.#store.change({ env: environment === 'none' ? undefined : environment });
			notice(words.placeNotShown(name, (error as Error).message), 'error');
		}
		this.changed();
	}

	/** Loads and shows a model; says why and keeps the one before where that fails. */
	async #show(name: string, own?: OwnModel): Promise<void> {
		const turn = ++this.#latest;
		const picture = this.#picture;
		const { stage } = picture;
		const { renderer, scene, sample } = stage;
		const first = stage.model === undefined;
		// No name of the menu has a slash in front.
		const shown = own ? `/${name}` : name;
		// The skin alone is better than nothing, and worse than the model before.
		let early: Model | undefined;
		// A skin on show stays until the next model is there, which may never come: so its fur grows.
		const late = () => turn !== this.#latest && (!early || early !== stage.model);
		const skin = (model: Model) => {
			if (turn !== this.#latest) return;
			early = model;
			this.#present(model, shown);
			void picture.frames.hold(compileScene(renderer, scene, picture.camera, sample));
			void picture.drawn().then(() => performance.mark('furbake:skin'));
		};
		const manager = this.#progress.begin();
		try {
			const folder = folderOf(name, this.menu, document.baseURI);
			if (!folder && !own) throw new Error(words.notAFolder);
			const sound = this.menu.some((entry) => entry.name === name);
			const source = own?.source ?? sourceAt(folder as URL, sound, manager);
			const model = own?.relit
				? await this.#pictured(own.relit)
				: await loadModel(source, stage.limits, first ? { skin } : {});
			if (late()) return model.dispose();
			if (own) this.#store.change({ model: undefined });
			if (model !== early) this.#present(model, shown);
			this.own = own !== undefined;
			if (turn === this.#latest) withdraw('model');
			this.#describe(model, own, name);
			await this.#dressing.dress(first);
		} catch (error) {
			if (late()) return;
			if (early) this.#clear();
			notice(words.notShown(name, (error as Error).message), 'error', 'model');
		} finally {
			own?.source.release();
		}
		this.changed();
	}

	/** A museum's picture as a model. */
	async #pictured(picture: Relit): Promise<Model> {
		const { stage } = this.#picture;
		const { relitModel } = await import('../rti/relitModel.ts');
		return relitModel(picture, stage.key, stage.limits.size);
	}

	/** Says why a model has no fur, where that is so. */
	#describe({ fur, newer, clips }: Model, own: OwnModel | undefined, name: string): void {
		const title = this.title ?? name;
		if (newer) notice(dropWords.newer(title, newer, FUR_VERSION), 'note', 'model');
		else if (own?.relit) return;
		else if (own?.command) {
			const advice = [dropWords.bakeIt(title, own.command), ...(clips ? [dropWords.willMove] : [])];
			notice(advice.join('\n'), 'advice', 'model');
		} else if (!fur) notice(words.noFur(title), 'note', 'model');
	}

	/** Puts a model on show, as it is. */
	#present(model: Model, name: string): void {
		const picture = this.#picture;
		const { stage, camera, light, lamp } = picture;
		const first = stage.model === undefined;
		// Clear it: the point is none of another body's.
		if (!first && name !== this.shown) this.#store.change({ target: undefined });
		const view = this.#store.get();
		camera.target = view.target;
		this.dynamics.clear();
		this.looks.clear();
		stage.setModel(model);
		this.#chooseClip(first);
		stage.setCrowd(1, undefined);
		this.shown = name;
		this.#front = facing(model.object, model.fur?.skin ?? model.object);
		lamp.visible = view.ui;
		if (!camera.chosen) camera.orbit = view.camera ?? this.#firstCamera();
		if (first || light.drifting) light.put(view.light ?? this.#firstLight(), !view.light);
		picture.updateLight();
		picture.fit();
	}

	/** Poses the model by the view; says so where that asks for a clip that is not there. @param first model of all: the view may be a link's */
	#chooseClip(first: boolean): void {
		const store = this.#store;
		const { clip } = store.get();
		const { names } = this.#picture.stage.model?.clips ?? {};
		if (!first) store.change(this.firstClip);
		else if (clip !== undefined && !names?.includes(clip)) {
			const [shown] = names ?? [];
			notice(shown ? words.wrongClip(clip, names?.join(', ') ?? '', shown) : words.noClips(clip));
			store.change({ clip: undefined });
		}
		if (store.get().time === undefined) store.change({ time: this.firstClip.time });
		this.dynamics.pose(store.get());
	}

	/** Takes the model away. */
	#clear(): void {
		this.dynamics.clear();
		this.looks.clear();
		this.#picture.stage.setModel(undefined);
		this.shown = '';
		this.own = false;
	}
}
