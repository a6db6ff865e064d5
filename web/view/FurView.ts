/** `<fur-view>`: a furry model in any page, lit by dragging. */

import { DEFAULT_CAMERA, DEFAULT_LIGHT } from '../page/light.ts';
import { ATTRIBUTES, format, parseCamera, parseLight, type Triple } from './attributes.ts';
import { type Frame, frame } from './frame.ts';
import { listenToHands } from './hands.ts';
import { defineProperties, SWITCHES, set, TEXTS, TRIPLES } from './properties.ts';
import { Session } from './Session.ts';
import type { FurView as Face, FurViewState } from './view.d.ts';
import { type Words, wordsFor } from './words.ts';

/** Node has no elements, and may import this module all the same. */
const Base = (globalThis.HTMLElement ?? class {}) as typeof HTMLElement;

/** As the types promise it; attributes and properties of one name are defined below the class. */
export interface FurView extends Pick<Face, (typeof TEXTS)[number] | (typeof SWITCHES)[number]> {}

// biome-ignore lint/suspicious/noUnsafeDeclarationMerging: the properties are defined in one loop
export class FurView extends Base implements Face {
	static readonly observedAttributes: readonly string[] = ATTRIBUTES;
	readonly #frame: Frame = frame(this);
	#session: Session | undefined;
	#state: FurViewState = 'idle';
	/** True once the view has been in the window, or nearly. */
	#isNear = false;
	/** True while a load is about to begin. */
	#isStale = false;
	/** True while drags turn the camera. */
	#turns = false;
	/** Whether the visitor wants the clip to play, once they have said so. */
	#wantsPlay: boolean | undefined;
	/** Attributes as the page has set them, and whether the view itself writes them now. */
	readonly #home: Record<(typeof TRIPLES)[number], string | null> = { light: null, camera: null };
	#writes = false;

	constructor() {
		super();
		const { canvas, turn, play, reset } = this.#frame;
		listenToHands(canvas, {
			turns: () => this.#turns,
			picture: () => (this.#session?.picture.shown ? this.#session.picture : undefined),
			lit: () => this.#moved(),
			turned: () => {
				this.#write('camera', format(this.camera));
				this.#session?.redraw();
			},
			active: (active) => this.#hold(active),
		});
		turn.addEventListener('click', () => {
			this.#turns = !this.#turns;
			turn.setAttribute('aria-pressed', String(this.#turns));
		});
		turn.setAttribute('aria-pressed', 'false');
		play.addEventListener('click', () => {
			const plays = !this.#plays;
			this.paused = !plays;
			this.#wantsPlay = plays;
			this.#animate();
		});
		reset.addEventListener('click', () => this.reset());
	}

	get state(): FurViewState {
		return this.#state;
	}

	get light(): Triple {
		const wanted = this.#session?.picture.light.wanted;
		return wanted ?? parseLight(this.getAttribute('light')) ?? [...DEFAULT_LIGHT];
	}

	set light(direction: Triple | string) {
		set(this, 'light', direction);
	}

	get camera(): Triple {
		return this.#session?.picture.camera.orbit ?? parseCamera(this.getAttribute('camera')) ?? [...DEFAULT_CAMERA];
	}

	set camera(orbit: Triple | string) {
		set(this, 'camera', orbit);
	}

	get clips(): readonly string[] {
		return this.#session?.picture.shown?.model.clips?.names ?? [];
	}

	reset(): void {
		for (const name of TRIPLES) this.#write(name, this.#home[name]);
		this.#aim();
		this.#dispatchLight();
	}

	connectedCallback(): void {
		// Of an element that was there before its class.
		for (const name of [...TEXTS, ...SWITCHES, ...TRIPLES]) {
			if (!Object.hasOwn(this, name)) continue;
			const { [name]: value } = this;
			delete (this as Partial<Record<typeof name, unknown>>)[name];
			Object.assign(this, { [name]: value });
		}
		if (this.#session) return;
		const session = new Session(this.#frame.canvas, this.#calm, () => {
			this.#isNear = true;
			this.#load();
		});
		this.#session = session;
		this.#label();
		if (session.works) {
			this.#surround();
			this.#aim();
		} else this.#fail(this.#words.noWebGL2, 'this browser has no WebGL2');
	}

	disconnectedCallback(): void {
		// Elements that are moved within the page come back at once.
		queueMicrotask(() => {
			if (this.isConnected || !this.#session) return;
			this.#session.dispose();
			this.#session = undefined;
			this.#isNear = false;
			this.#setState('idle');
		});
	}

	attributeChangedCallback(name: string, before: string | null, value: string | null): void {
		if (before === value) return;
		if (name === 'light' || name === 'camera') {
			if (this.#writes) return;
			this.#home[name] = value;
			if (name === 'light' && this.#state === 'ready') this.#turnLight();
			else this.#aim();
		} else if (name === 'src' || name === 'preset') this.#load();
		else if (name === 'environment') this.#surround();
		else if (name === 'clip' || name === 'paused') {
			this.#wantsPlay = undefined;
			this.#animate();
		} else this.#label();
	}

	get #words(): Words {
		return wordsFor(this);
	}

	/** Whether nothing is to move by itself. */
	get #calm(): boolean {
		return matchMedia('(prefers-reduced-motion: reduce)').matches;
	}

	get #plays(): boolean {
		return this.clip !== '' && (this.#wantsPlay ?? !(this.paused || this.#calm));
	}

	#setState(state: FurViewState): void {
		this.#state = state;
		const { dataset } = this.#frame.root;
		dataset.state = state;
		// A picture stays while the next one is loading.
		if (state === 'ready') dataset.shown = '';
		else if (state !== 'loading') delete dataset.shown;
	}

	/** Says what the controls do, and shows those that there are. */
	#label(): void {
		const { say, tools, play } = this.#frame;
		say(this.#words, this.alt, this.#plays);
		tools.classList.toggle('shown', this.controls);
		play.hidden = !this.clip || this.clips.length === 0;
		this.#hold(false);
	}

	/** Says why there is no picture. @param reason in English, for the page */
	#fail(text: string, reason: string): void {
		this.#frame.explain(text);
		this.#setState('failed');
		this.#complain(reason);
	}

	#complain(message: string): void {
		this.dispatchEvent(new ErrorEvent('error', { message: `fur-view: ${message}` }));
	}

	/** Loads what the attributes say, after all changes of this moment. */
	#load(): void {
		if (this.#isStale || !this.#isNear) return;
		this.#isStale = true;
		queueMicrotask(() => {
			this.#isStale = false;
			void this.#show();
		});
	}

	async #show(): Promise<void> {
		const session = this.#session;
		if (!session?.works) return;
		const { src, preset } = this;
		if (!src) {
			session.clear();
			this.#setState('idle');
			return;
		}
		this.#setState('loading');
		try {
			const reason = await session.show({ src, preset }, () => this.#animate());
			if (reason === undefined) return;
			this.#setState('ready');
			if (reason) this.#complain(`preset: ${reason}`);
			this.dispatchEvent(new Event('ready'));
		} catch (error) {
			const { message } = error as Error;
			session.clear();
			this.#fail(this.#words.notShown(message), message);
		}
	}

	#surround(): void {
		const session = this.#session;
		if (!session?.works) return;
		try {
			session.surround(this.environment);
		} catch (error) {
			session.surround('');
			this.#complain(`environment: ${(error as Error).message}`);
		}
		if (!this.#home.light) this.#aim();
	}

	/** Puts light and camera at once where the attributes say. */
	#aim(): void {
		const { picture } = this.#session ?? {};
		if (!picture) return;
		picture.shineFrom(parseLight(this.getAttribute('light')) ?? picture.sun ?? [...DEFAULT_LIGHT]);
		picture.camera.orbit = parseCamera(this.getAttribute('camera')) ?? [...DEFAULT_CAMERA];
		this.#session?.redraw();
	}

	/** Lets the light glide to where the attribute says. */
	#turnLight(): void {
		const light = parseLight(this.getAttribute('light')) ?? this.#session?.picture.sun ?? DEFAULT_LIGHT;
		this.#session?.picture.light.want((wanted) => wanted.set(...light).normalize());
		this.#session?.wake();
	}

	/** Plays or holds the clip. */
	#animate(): void {
		const { clips } = this.#session?.picture.shown?.model ?? {};
		const { clip } = this;
		if (clips && clip && clips.names.includes(clip)) clips.choose(clip);
		else if (clips && clip) this.#complain(`clip: got ${clip}, expected one of ${clips.names.join(', ')}`);
		else if (clip && this.#session?.picture.shown) this.#complain(`clip: got ${clip}, and a model without clips`);
		if (this.#plays) clips?.play();
		else clips?.hold(clip ? clips.time : 0);
		this.#label();
		this.#session?.wake();
	}

	/** Reports that a visitor has moved the light. */
	#moved(): void {
		this.#write('light', format(this.light));
		this.#session?.wake();
		this.#dispatchLight();
	}

	#dispatchLight(): void {
		this.dispatchEvent(new CustomEvent('lightchange', { detail: { light: this.light } }));
	}

	/** Shows the lamp where the light is held by its handle. */
	#hold(held: boolean): void {
		const { lamp } = this.#session?.picture ?? {};
		if (!lamp) return;
		const visible = held || this.controls;
		if (lamp.visible === visible && lamp.active === held) return;
		Object.assign(lamp, { visible, active: held });
		this.#session?.redraw();
		this.#session?.wake();
	}

	#write(name: (typeof TRIPLES)[number], value: string | null): void {
		this.#writes = true;
		if (value === null) this.removeAttribute(name);
		else this.setAttribute(name, value);
		this.#writes = false;
	}
}

defineProperties(FurView.prototype);
