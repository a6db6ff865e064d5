/** Controls of the page: panel, tools and line of the split. Each changes the view, and the picture by it. */

import { copy, download } from '../../page/share.ts';
import type { Tools } from '../hands/tools.ts';
import { bakedColours, hasOwnColours } from '../model/colours.ts';
import type { Exhibit } from '../model/exhibit.ts';
import { type MenuEntry, offered, pelts } from '../model/menu.ts';
import { hasEigen, statesFor } from '../model/outfits.ts';
import { notice } from '../say/notice.ts';
import type { Picture } from '../stage/picture.ts';
import { formatAddress } from '../state/address.ts';
import type { Abilities, Shown } from '../state/controls.ts';
import { NAMES, type Part, parameters } from '../state/parameters.ts';
import type { Store } from '../state/store.ts';
import { isRival, type View } from '../state/view.ts';
import { words } from '../words/index.ts';
import { type Menu, Panel } from './panel.ts';
import { SplitLine } from './split.ts';

/** Values that a reset keeps. */
const KEPT: readonly (keyof View)[] = ['model', 'still', 'ui', 'lang'];

/** Rounded as the panel shows them. */
const seconds = (time = 0) => Math.round(100 * time) / 100;

const titleOf = (entry: MenuEntry, name: string) => words.titles[name] ?? entry.title;

const menuOf = (entries: readonly MenuEntry[], value: (entry: MenuEntry) => string): Menu =>
	entries.map((entry) => ({ value: value(entry), title: titleOf(entry, value(entry)) }));

export class Controls {
	readonly panel: Panel;
	readonly #tools: Tools;
	readonly #picture: Picture;
	readonly #exhibit: Exhibit;
	readonly #store: Store;
	readonly #line: SplitLine;

	constructor(container: HTMLElement, tools: Tools, picture: Picture, exhibit: Exhibit, store: Store) {
		this.#tools = tools;
		this.#picture = picture;
		this.#exhibit = exhibit;
		this.#store = store;
		this.#line = new SplitLine(picture, (share) => {
			const { split } = store.get();
			if (!split) return;
			store.change({ split: { ...split, share } });
			exhibit.looks.setSplit(picture.columnOf(share));
			picture.request();
		});
		picture.framed = () => {
			const { split } = store.get();
			if (!split) return;
			exhibit.looks.setSplit(picture.columnOf(split.share));
			this.#line.place();
		};
		this.panel = new Panel(container, {
			view: () => store.get(),
			changed: (patch, part) => this.#change(patch, part),
			copy: () => void this.#copy(),
			save: () => void this.#save(),
			reset: () => void this.#reset(),
			clean: () => {
				exhibit.dynamics.clean();
				this.#change({ wet: undefined, dirt: undefined }, 'style');
			},
			bakedColours: () => this.#change({ colour: undefined }, 'style'),
		});
		exhibit.changed = () => this.#update();
		exhibit.dynamics.posed = (time) => this.panel.follow(seconds(time));
		store.subscribe((_, changed) => {
			if (changed.some((name) => parameters[name].controls)) this.#update();
		});
	}

	/** Changes the view, and the part of the page that follows; a model or an environment enters the view once it has come. */
	#change(patch: Partial<View>, part: Part): void {
		const exhibit = this.#exhibit;
		if (part === 'model') {
			if (patch.model) void exhibit.show(patch.model);
		} else if (part === 'environment') {
			void exhibit.surround(patch.env ?? 'none');
		} else {
			this.#store.change(patch);
			void (part === 'fur' ? exhibit.dress() : exhibit.style());
		}
	}

	/** Updates panel, tools, line and overlay. */
	#update(): void {
		const { menu, shown, environment, looks } = this.#exhibit;
		const view = this.#store.get();
		const { fur } = looks;
		const able = this.#abilities();
		// A model that the menu does not offer has an entry of its own while it is on show.
		const other = shown && !offered(menu).some(({ name }) => name === shown);
		const others = other ? [{ value: shown, title: this.#exhibit.title ?? shown }] : [];
		const nothing = shown ? [] : [{ value: '', title: '–' }];
		this.panel.offer('model', [...nothing, ...menuOf(offered(menu), ({ name }) => name), ...others]);
		const own = { value: '', title: words.asBaked };
		const { clips } = this.#picture.stage.model ?? {};
		this.panel.offer('clip', clips?.names.map((name) => ({ value: name, title: name })) ?? []);
		this.panel.offer('preset', [own, ...menuOf(pelts(menu), ({ pelt }) => pelt ?? '')]);
		const values: Shown = {
			...{ model: shown, env: environment, shells: Math.round(fur?.shells.shellCount ?? 1) },
			colour: fur ? bakedColours(fur) : ['000000', '000000'],
			...{ clip: clips?.name ?? '', time: seconds(clips?.time), duration: clips?.duration ?? 0 },
		};
		this.panel.update(values, able);
		const brush = able.fur && able.alone;
		const stains = { rain: brush && able.wet, mud: brush && able.dirt };
		this.#tools.offer({ light: true, stroke: brush, ...stains, move: shown !== '' && able.alone });
		const { split, method = 'ptm' } = view;
		this.#line.show(words.methods[method], split && fur && words.methods[split.method], split?.share ?? 1);
		const { overlay } = this.#picture;
		if (overlay) overlay.shells = able.alone ? fur?.shells : undefined;
	}

	#abilities(): Abilities {
		const { menu, shown, looks, entry } = this.#exhibit;
		const view = this.#store.get();
		const { fur, body } = looks;
		const { clips } = this.#picture.stage.model ?? {};
		const lit = !isRival(view.method ?? 'ptm') || (view.split && !isRival(view.split.method));
		return {
			...{ model: shown !== '', fur: fur !== undefined, fins: fur?.fins !== undefined && Boolean(lit) },
			...{ eigen: hasEigen(view, entry, menu), root: fur !== undefined && !hasOwnColours(fur) },
			...statesFor(view, entry, menu, body),
			...{ calm: this.#picture.calm, alone: !fur || (view.crowd ?? 1) <= 1 },
			...{ clips: clips !== undefined, plays: !this.#picture.still },
			looks: clips?.gaze !== undefined && !this.#picture.calm,
		};
	}

	/** The address of exactly this picture. */
	get link(): string {
		const { light, camera } = this.#picture;
		const { shown, entry } = this.#exhibit;
		const view = this.#store.get();
		const exact: View = {
			...view,
			model: view.model ?? (entry && shown),
			light: light.drifting ? light.direction.toArray() : light.wanted,
			camera: camera.orbit,
		};
		return new URL(formatAddress(exact), location.href).href;
	}

	async #copy(): Promise<void> {
		const { link } = this;
		const { own, dynamics } = this.#exhibit;
		const more = [...(own ? [words.noLink] : []), ...(dynamics.hasPaint ? [words.notInLink] : [])];
		const done = await copy(link);
		const copied = more.length ? words.copiedPart : words.copied;
		// A link that is to be copied by hand stays until it is.
		notice([done ? copied : words.copyThis(link), ...more].join('\n'), done ? 'note' : 'advice', 'link');
	}

	async #save(): Promise<void> {
		try {
			const file = `furbake-${this.#exhibit.shown.split('/').filter(Boolean).at(-1) ?? 'picture'}.png`;
			download(await this.#picture.file(), file);
			notice(words.saved(file));
		} catch (error) {
			notice(words.notSaved((error as Error).message), 'error');
		}
	}

	/** Resets everything but the model. */
	async #reset(): Promise<void> {
		const { camera } = this.#picture;
		const left = NAMES.filter((name) => !KEPT.includes(name));
		this.#store.change({ ...Object.fromEntries(left.map((name) => [name, undefined])), ...this.#exhibit.firstClip });
		camera.chosen = false;
		this.#exhibit.dynamics.reset();
		this.#tools.choose('light');
		await Promise.all([this.#exhibit.surround('none'), this.#exhibit.dress()]);
		this.#exhibit.aim();
		this.#update();
	}
}
