/** What the controls do: each changes the view, and the picture by it. */

import { copy, download } from '../page/share.ts';
import { addressWriter, formatAddress, type View } from './address.ts';
import { bakedColours, hasOwnColours } from './colours.ts';
import type { Exhibit } from './exhibit.ts';
import { type MenuEntry, offered, pelts } from './models.ts';
import { notice } from './notice.ts';
import { hasEigen, isRival, statesFor } from './outfits.ts';
import { type Menu, Panel, type Settings } from './panel.ts';
import type { Picture } from './picture.ts';
import { SplitLine } from './split.ts';
import { Tools } from './tools.ts';
import { words } from './words/index.ts';

/** What stays when everything else is as at first. */
const kept = ['model', 'still', 'ui', 'lang'] as const satisfies (keyof View)[];

const middle = 0.5;
/** Where the wind blows to until somebody says, degrees: to the right. */
const right = 90;

const menuOf = (entries: readonly MenuEntry[], value: (entry: MenuEntry) => string): Menu =>
	entries.map((entry) => ({ value: value(entry), title: titleOf(entry, value(entry)) }));

const titleOf = (entry: MenuEntry, name: string) => words.titles[name] ?? entry.title;

export class Controls {
	readonly panel: Panel;
	readonly tools = new Tools();
	readonly #picture: Picture;
	readonly #exhibit: Exhibit;
	readonly #view: View;
	readonly #write = addressWriter();
	readonly #line: SplitLine;
	/** What a control does; what none is here for changes the view and the style of the hairs, no more. */
	readonly #actions: { [Name in keyof Settings]?: (value: Settings[Name]) => void };

	constructor(container: HTMLElement, picture: Picture, exhibit: Exhibit, view: View) {
		this.#picture = picture;
		this.#exhibit = exhibit;
		this.#view = view;
		this.#line = new SplitLine(picture.canvas, (share) => {
			if (!view.split) return;
			view.split.share = share;
			exhibit.looks.cut(share);
			this.write();
			picture.request();
		});
		const dress = (part: Partial<View>) => {
			Object.assign(view, part);
			void exhibit.dress().then(() => this.write());
		};
		this.#actions = {
			model: (name) => void this.#show(name),
			preset: (name) => dress({ preset: name || undefined }),
			method: (method) => dress({ method: method === 'ptm' ? undefined : method }),
			split: (method) => {
				const share = view.split?.share ?? middle;
				dress({ split: method === 'none' ? undefined : { method, share } });
			},
			crowd: (crowd) => dress({ crowd: crowd > 1 ? crowd : undefined }),
			environment: (place) => void this.#move(place),
			lights: (lights) => {
				view.lights = lights > 1 ? lights : undefined;
				picture.stage.lamps = lights;
			},
			automatic: (automatic) => {
				const { shellCount = 1 } = exhibit.looks.fur?.shells ?? {};
				view.shells = automatic ? undefined : Math.round(shellCount);
			},
			fins: (fins) => {
				view.fins = fins ? undefined : false;
			},
			root: () => this.#mix(),
			tip: () => this.#mix(),
			wind: () => this.#blow(),
			direction: () => this.#blow(),
			wetness: (wet) => {
				view.wet = wet || undefined;
			},
			dirt: (dirt) => {
				view.dirt = dirt || undefined;
			},
			turntable: (turn) => {
				view.turn = turn || undefined;
			},
		};
		this.panel = new Panel(container, {
			changed: (name, value) => {
				const act = this.#actions[name] as ((given: unknown) => void) | undefined;
				if (act) act(value);
				else Object.assign(view, { [name]: value });
				this.#restyle();
			},
			copy: () => void this.#copy(),
			save: () => void this.#save(),
			reset: () => void this.#reset(),
			clean: () => {
				view.wet = view.dirt = undefined;
				exhibit.living.clean();
				this.#restyle();
			},
			bakedColours: () => {
				view.colour = undefined;
				this.#restyle();
			},
		});
		exhibit.changed = () => this.update();
	}

	/** Has the address say what the page shows. */
	write(): void {
		this.#write(this.#view);
	}

	/** Hairs as the view says. */
	#restyle(): void {
		void this.#exhibit.style().then(() => this.write());
		this.update();
		this.write();
	}

	async #show(name: string): Promise<void> {
		if (!name) return;
		if (await this.#exhibit.show(name)) this.#view.model = name;
		this.write();
	}

	async #move(place: Settings['environment']): Promise<void> {
		if (await this.#exhibit.move(place)) this.#view.env = place === 'none' ? undefined : place;
		this.write();
	}

	/** Takes both colours from the panel. */
	#mix(): void {
		const { root, tip } = this.panel.settings;
		this.#view.colour = [root.slice(1), tip.slice(1)];
	}

	/** Takes the wind from the panel. */
	#blow(): void {
		const { wind, direction } = this.panel.settings;
		this.#view.wind = wind === 0 && direction === right ? undefined : [wind, direction];
	}

	/** Shows how things are. */
	update(): void {
		const { menu, shown, place, looks, entry } = this.#exhibit;
		const view = this.#view;
		const { fur } = looks;
		// What the menu does not offer gets an entry of its own while it is on show.
		const other = shown && !offered(menu).some(({ name }) => name === shown);
		const others = other ? [{ value: shown, title: this.#exhibit.title ?? shown }] : [];
		const nothing = shown ? [] : [{ value: '', title: '–' }];
		this.panel.offer('model', [...nothing, ...menuOf(offered(menu), ({ name }) => name), ...others]);
		const own = { value: '', title: words.asBaked };
		this.panel.offer('preset', [own, ...menuOf(pelts(menu), ({ pelt }) => pelt ?? '')]);
		const [root, tip] = view.colour ?? (fur ? bakedColours(fur) : ['000000', '000000']);
		const crowd = fur ? (view.crowd ?? 1) : 1;
		const settings: Settings = {
			...{ model: shown, preset: view.preset ?? '', crowd },
			...{ method: view.method ?? 'ptm', split: view.split?.method ?? 'none' },
			...{ lights: view.lights ?? 1, environment: place },
			...{ automatic: view.shells === undefined, shells: Math.round(view.shells ?? fur?.shells.shellCount ?? 1) },
			...{ fins: view.fins ?? true, length: view.length ?? 1, density: view.density ?? 1 },
			...{ root: `#${root}`, tip: `#${tip}` },
			...{ wind: view.wind?.[0] ?? 0, direction: view.wind?.[1] ?? right },
			...{ wetness: view.wet ?? 0, dirt: view.dirt ?? 0, turntable: view.turn ?? false },
		};
		const states = statesFor(view, entry, menu, looks.body);
		this.panel.update(settings, {
			fur: fur !== undefined,
			fins: fur?.fins !== undefined && !(isRival(settings.method) && (!view.split || isRival(view.split.method))),
			eigen: hasEigen(view, entry, menu),
			root: fur !== undefined && !hasOwnColours(fur),
			states,
			calm: this.#picture.calm,
		});
		const alone = crowd === 1;
		const brush = fur !== undefined && alone;
		const { wet, dirt } = states;
		this.tools.offer({
			light: true,
			stroke: brush,
			rain: brush && wet,
			mud: brush && dirt,
			move: shown !== '' && alone,
		});
		const { split } = view;
		const left = words.methods[settings.method];
		this.#line.show(left, split && fur && words.methods[split.method], split?.share ?? 1);
		const { overlay } = this.#picture;
		if (overlay) overlay.shells = crowd > 1 ? undefined : fur?.shells;
	}

	/** The address of just this picture. */
	get link(): string {
		const { light, camera } = this.#picture;
		const { shown, entry } = this.#exhibit;
		const view = this.#view;
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
		const { own, living } = this.#exhibit;
		const more = [...(own ? [words.noLink] : []), ...(living.marked ? [words.notInLink] : [])];
		notice([(await copy(link)) ? words.copied : words.copyThis(link), ...more].join('\n'));
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

	/** All as it is at first, but for the model. */
	async #reset(): Promise<void> {
		const { camera, stage } = this.#picture;
		const view = this.#view;
		for (const name of Object.keys(view) as (keyof View)[])
			if (!(kept as readonly string[]).includes(name)) delete view[name];
		camera.chosen = false;
		stage.lamps = 1;
		this.#exhibit.living.reset();
		this.tools.choose('light');
		await Promise.all([this.#exhibit.move('none'), this.#exhibit.dress()]);
		this.#exhibit.aim();
		this.update();
		this.write();
	}
}
