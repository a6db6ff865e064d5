/** `<fur-view>`: a furry model in any page, lit by dragging. */

import { DEFAULT_CAMERA, DEFAULT_LIGHT } from '../page/light.ts';
import { ATTRIBUTES, format, parseCamera, parseLight, TRIPLE, type Triple } from './attributes.ts';
import { type Failure, type Frame, frame } from './frame.ts';
import { listenToHands } from './hands.ts';
import { defineProperties, SWITCHES, set, TEXTS, TRIPLES } from './properties.ts';
import { Session } from './Session.ts';
import type { FurView as Face, FurViewState } from './view.d.ts';
import { wordsFor } from './words.ts';

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
	#failure: Failure | undefined;
	/** Clip on show; one that comes is held where less motion is asked for. */
	#clip = '';
	/** Follows the language of the page. */
	readonly #language = new MutationObserver(() => this.#label());
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
			this.paused = !this.paused;
		});
		reset.addEventListener('click', () => {
			const before = format(this.light);
			this.reset();
			if (format(this.light) !== before) this.#dispatchLight();
		});
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
		this.#language.observe(document.documentElement, { attributeFilter: ['lang'] });
		this.#label();
		if (session.works) {
			this.#surround();
			this.#aim();
		} else this.#fail('noWebGL2');
	}

	disconnectedCallback(): void {
		// Elements that are moved within the page come back at once.
		queueMicrotask(() => {
			if (this.isConnected || !this.#session) return;
			this.#session.dispose();
			this.#session = undefined;
			this.#language.disconnect();
			this.#isNear = false;
			this.#setState('idle');
		});
	}

	attributeChangedCallback(name: string, before: string | null, value: string | null): void {
		if (before === value) return;
		if (name === 'light' || name === 'camera') {
			if (this.#writes) return;
			this.#home[name] = value;
			const { parse, expected } = TRIPLE[name];
			if (value && !parse(value)) this.#complain(`${name}: got ${value}, expected ${expected}`);
			if (name === 'light' && this.#state === 'ready') this.#turnLight();
			else this.#aim();
		} else if (name === 'src' || name === 'preset') this.#load();
		else if (name === 'environment') this.#surround();
		else if (name === 'clip' || name === 'paused') this.#animate();
		else this.#label();
	}

	/** Whether nothing is to move by itself. */
	get #calm(): boolean {
		return matchMedia('(prefers-reduced-motion: reduce)').matches;
	}

	#setState(state: FurViewState): void {
		this.#state = state;
		if (state !== 'failed') this.#failure = undefined;
		this.#label();
		const { dataset } = this.#frame.root;
		dataset.state = state;
		// A picture stays while the next one is loading.
		if (state === 'ready') dataset.shown = '';
		else if (state !== 'loading') delete dataset.shown;
	}

	/** Says what the controls do, and shows those that there are. */
	#label(): void {
		const { say, tools, play } = this.#frame;
		say(wordsFor(this), this.getAttribute('alt') ?? (this.ariaLabel || null), !this.paused, this.#failure);
		tools.classList.toggle('shown', this.controls);
		play.hidden = !this.clips.includes(this.clip);
		this.#hold(false);
	}

	/** Says why there is no picture. @param reason in English, beside the text */
	#fail(text: Failure['text'], reason = ''): void {
		this.#failure = { text, reason };
		this.#setState('failed');
		this.#complain(reason || 'this browser has no WebGL2');
	}

	/** Tells the page, and its author unless the page takes it upon itself. */
	#complain(reason: string): void {
		const message = `fur-view: ${reason}`;
		const event = new ErrorEvent('error', { message, cancelable: true });
		if (this.dispatchEvent(event)) console.warn(`${message} (src="${this.src}")`);
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
			if (reason) this.#complain(reason);
			this.dispatchEvent(new Event('ready'));
		} catch (error) {
			const { message } = error as Error;
			session.clear();
			this.#fail('notShown', message);
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
		const { model } = this.#session?.picture.shown ?? {};
		const { clips } = model ?? {};
		const clip = this.clips.includes(this.clip) ? this.clip : '';
		if (model && this.clip && !clip) {
			const expected = clips ? `expected one of ${clips.names.join(', ')}` : 'and a model without clips';
			this.#complain(`clip: got ${this.clip}, ${expected}`);
		}
		const isOther = clip !== this.#clip;
		this.#clip = clip;
		if (isOther && clip && this.#calm) this.paused = true;
		// Without a clip as if there had never been one.
		clips?.choose(clip || `${clips.names[0]}`);
		if (clip && !this.paused) clips?.play();
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
