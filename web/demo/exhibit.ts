/** What is on show: a model of the menu or of the address, in a pelt, in a place; and whether that is all that was asked for. */

import { VERSION } from '../fur/index.ts';
import { setState } from '../page/element.ts';
import type { Triple, View } from './address.ts';
import type { OwnModel } from './drop.ts';
import { type EnvironmentName, loadEnvironment } from './environments.ts';
import { wantsFine } from './fine.ts';
import { Living } from './living.ts';
import { Looks } from './looks.ts';
import { textureBytes } from './memory.ts';
import {
	defaultLight,
	firstView,
	folderOf,
	loadMenu,
	loadModel,
	type MenuEntry,
	type Model,
	offered,
	sourceAt,
} from './models.ts';
import { notice, withdraw } from './notice.ts';
import { adjust, availableOutfits, fineOutfits, type Wearer } from './outfits.ts';
import type { Picture } from './picture.ts';
import { Play } from './play.ts';
import type { Progress } from './progress.ts';
import { en } from './words/drop.en.ts';
import { zh } from './words/drop.zh.ts';
import { language, words } from './words/index.ts';

const ownWords = { en, zh }[language];

export class Exhibit {
	menu: MenuEntry[] = [];
	/** Name or address of the model on show, with a slash at its front if it is a visitor's own; '' for none. */
	shown = '';
	/** Whether it is a visitor's own, which no link can name. */
	own = false;
	place: EnvironmentName | 'none' = 'none';
	readonly looks = new Looks();
	readonly living: Living;
	readonly play: Play;
	/** Called when something else is on show, or what was asked for has failed. */
	changed: () => void = () => {};
	readonly #picture: Picture;
	readonly #view: View;
	readonly #progress: Progress;
	#pending = 0;
	#latestModel = 0;
	#latestPlace = 0;
	#latestOutfit = 0;
	/** Whether what is worn has been asked for its states. */
	#soiled = false;
	/** Where the lamp of the place stands. */
	#sun: Triple | undefined;

	/** @param view what is asked for; what cannot be had is taken out of it */
	constructor(picture: Picture, view: View, progress: Progress) {
		this.#picture = picture;
		this.#view = view;
		this.#progress = progress;
		this.living = new Living(this.looks, picture.stage, picture.calm);
		this.play = new Play(picture, this.looks, this.living);
		const { stage, camera } = picture;
		picture.live = (elapsed) => Math.min(this.play.step(elapsed), this.looks.step(elapsed));
		picture.before = () => this.looks.before(stage.renderer, stage.scene, camera, stage.key);
	}

	get entry(): MenuEntry | undefined {
		return this.menu.find(({ name }) => name === this.shown);
	}

	/** What the model on show is called; undefined for none. */
	get title(): string | undefined {
		const { entry, shown } = this;
		return entry ? (words.titles[entry.name] ?? entry.title) : shown.replace(/^\//, '') || undefined;
	}

	/** Opens with what the view asks for. */
	async open(): Promise<void> {
		const view = this.#view;
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
			view.model = undefined;
			name = first;
		}
		this.changed();
		const { camera } = this.#picture;
		if (view.camera) camera.chosen = true;
		camera.orbit = view.camera ?? firstView(undefined).camera;
		await this.change(async () => {
			await Promise.all([this.#enter(view.env ?? 'none'), this.#show(name)]);
		});
	}

	/** Shows another model. @returns whether it is on show now */
	async show(name: string): Promise<boolean> {
		await this.change(() => this.#show(name));
		return this.shown === name;
	}

	/** Shows a visitor's own model, which has no address. */
	receive(own: OwnModel): Promise<void> {
		return this.change(() => this.#show(own.name, own));
	}

	/** Has another place's light fall on the model. @returns whether it is there now */
	async move(place: EnvironmentName | 'none'): Promise<boolean> {
		await this.change(() => this.#enter(place));
		return this.place === place;
	}

	/** Has the model wear what the view says. */
	dress(): Promise<void> {
		return this.change(() => this.#dress());
	}

	/** Has the hairs of what it wears be as the view says, and the weather. @returns when that can be seen */
	style(): Promise<void> {
		this.looks.style(this.#view);
		this.living.style(this.#view);
		this.#picture.stage.gather(this.#view.crowd ?? 1, this.looks.fur);
		this.#picture.request();
		return !this.#soiled && this.play.soils(this.#view) ? this.dress() : Promise.resolve();
	}

	/** Light and camera as they are before anybody has touched them. */
	aim(): void {
		const picture = this.#picture;
		const view = this.#view;
		if (!picture.camera.chosen) picture.camera.orbit = view.camera ?? this.#firstCamera();
		picture.shine(view.light ?? this.#firstLight(), !view.light);
		picture.fit();
	}

	/** Does something that may take long; the page says so meanwhile, and when the whole picture is on show. */
	async change(what: () => Promise<void>): Promise<void> {
		this.#pending++;
		setState('loading');
		await what().finally(() => {
			this.#pending--;
		});
		await this.settle();
	}

	/** Says so when all is on show. */
	async settle(): Promise<void> {
		const { stage } = this.#picture;
		if (this.#pending > 0) return;
		if (!stage.model) return setState('failed');
		// Two frames: the first one may still be on its way to the screen.
		await this.#picture.drawn();
		await this.#picture.drawn();
		if (this.#pending === 0 && !stage.gl.isContextLost()) setState('ready');
	}

	#firstLight(): Triple {
		return this.#sun ?? firstView(this.entry).light;
	}

	#firstCamera(): Triple {
		return firstView(this.entry, this.#view.crowd).camera;
	}

	/** Where that fails, says why and stays. */
	async #enter(name: EnvironmentName | 'none'): Promise<void> {
		const turn = ++this.#latestPlace;
		const picture = this.#picture;
		try {
			const [x, , z] = defaultLight;
			const environment = name === 'none' ? undefined : await loadEnvironment(name, Math.atan2(z, x));
			if (turn !== this.#latestPlace) return environment?.background.dispose();
			picture.stage.surround(environment);
			this.#sun = environment?.key.direction?.toArray();
			this.place = name;
			if (picture.stage.model && !this.#view.light) picture.light.put(this.#firstLight(), true);
			picture.aim();
			this.#weigh();
		} catch (error) {
			if (turn !== this.#latestPlace) return;
			this.#view.env = this.place === 'none' ? undefined : this.place;
			notice(words.placeNotShown(name, (error as Error).message), 'error');
		}
		this.changed();
	}

	/** Where that fails, says why and keeps the model before. */
	async #show(name: string, own?: OwnModel): Promise<void> {
		const turn = ++this.#latestModel;
		const { stage } = this.#picture;
		const first = stage.model === undefined;
		// No name of the menu has a slash at its front.
		const shown = own ? `/${name}` : name;
		// The skin alone is better than nothing, and worse than the model before.
		let early: Model | undefined;
		// A skin that is on show stays until the next model is there, and it may never come: so its fur grows.
		const late = () => turn !== this.#latestModel && (!early || early !== stage.model);
		const skin = (model: Model) => {
			if (turn !== this.#latestModel) return;
			early = model;
			this.#present(model, shown);
			void this.#picture.drawn().then(() => performance.mark('furbake:skin'));
		};
		const manager = this.#progress.begin();
		try {
			const folder = folderOf(name, this.menu, document.baseURI);
			if (!folder && !own) throw new Error(words.notAFolder);
			const source = own?.source ?? sourceAt(folder as URL, manager);
			const model = await loadModel(source, stage.limits, first ? { skin } : {});
			if (late()) return model.dispose();
			if (own) this.#view.model = undefined;
			if (model !== early) this.#present(model, shown);
			this.own = own !== undefined;
			if (turn === this.#latestModel) withdraw('model');
			const title = this.title ?? name;
			if (model.newer) notice(ownWords.newer(title, model.newer, VERSION), 'note', 'model');
			else if (own?.command) notice(ownWords.bakeIt(title, own.command), 'advice', 'model');
			else if (!model.fur) notice(words.noFur(title), 'note', 'model');
			await this.#dress(first);
		} catch (error) {
			if (late()) return;
			if (early) {
				this.living.strip();
				this.looks.strip();
				stage.show(undefined);
				this.shown = '';
				this.own = false;
			}
			notice(words.notShown(name, (error as Error).message), 'error', 'model');
		} finally {
			own?.source.release();
		}
		this.changed();
	}

	/** Puts a model on show, as it is. */
	#present(model: Model, name: string): void {
		const picture = this.#picture;
		const { stage, camera, light, lamp } = picture;
		const first = stage.model === undefined;
		this.living.strip();
		this.looks.strip();
		stage.show(model);
		stage.gather(1, undefined);
		this.shown = name;
		lamp.visible = this.#view.ui;
		if (!camera.chosen) camera.orbit = this.#view.camera ?? this.#firstCamera();
		if (first || light.drifting) light.put(this.#view.light ?? this.#firstLight(), !this.#view.light);
		picture.aim();
		picture.fit();
	}

	/** @param early whether this is the first fur of all: then it shows at once, and whole a frame later */
	async #dress(early = false): Promise<void> {
		const turn = ++this.#latestOutfit;
		const picture = this.#picture;
		const { stage } = picture;
		const { model } = stage;
		const view = this.#view;
		if (!model?.fur) return this.changed();
		for (const reason of adjust(view, this.entry, this.menu)) notice(reason);
		const soiled = this.play.soils(view);
		this.#soiled = soiled;
		const wearer = { body: model.fur, soiled, entry: this.entry, limits: stage.limits };
		const { outfits, whole } = await availableOutfits(view, this.menu, wearer);
		const wanted = wantsFine(view.planes);
		const fine = wanted ? await fineOutfits(view, this.menu, wearer, false) : undefined;
		const late = () => turn !== this.#latestOutfit || model !== stage.model;
		if (late()) return;
		this.looks.wear(model.fur, fine ?? outfits, view);
		this.looks.cut(view.split?.share ?? 1);
		this.living.style(view);
		stage.gather(view.crowd ?? 1, this.looks.fur);
		stage.lamps = view.lights ?? 1;
		picture.aim();
		picture.fit();
		if (early) {
			await this.looks.grow(view, () => picture.drawn());
			performance.mark('furbake:fur');
		}
		const loaded = !soiled || (await this.living.load(view));
		if (late()) return;
		// What has failed is asked for another time.
		this.#soiled = soiled && whole && loaded;
		this.living.style(view);
		this.#weigh();
		this.changed();
		if (!wanted || fine) return;
		const refined = this.#refine(wearer, late);
		// What was asked for by name belongs to the whole picture.
		if (view.planes === '128') await refined;
	}

	/** Has the fur go over to finer planes; where they cannot be had it stays as it is. */
	async #refine(wearer: Wearer, late: () => boolean): Promise<void> {
		const view = this.#view;
		try {
			const [outfits, { refine }] = await Promise.all([
				fineOutfits(view, this.menu, wearer, true),
				import('./refine.ts'),
			]);
			if (!outfits || late() || !(await refine(this.#picture, this.looks, outfits, view, late))) return;
			this.#weigh();
			this.changed();
		} catch (error) {
			if (!late() && view.planes === '128') notice(words.planesNotShown((error as Error).message), 'error');
		}
	}

	/** Tells the figures what the textures weigh. */
	#weigh(): void {
		const { overlay, stage } = this.#picture;
		if (overlay) overlay.textures = textureBytes(stage.scene);
	}
}
