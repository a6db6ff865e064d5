/** Looks of the body on show: a pelt lit by a method, or two side by side. */

import type { Scene, Texture } from 'three';
import {
	dressFur,
	type Fur,
	type FurFade,
	type FurMethod,
	type FurMethodName,
	type FurMethodOptions,
	type FurMotion,
	type FurWeather,
	type furMethod,
	updateFurs,
} from '../../fur/index.ts';
import type { ShellSpacing } from '../stage/spacing.ts';
import type { Store } from '../state/store.ts';
import type { View } from '../state/view.ts';
import { style } from './style.ts';

export interface Outfit {
	/** Pelt in the place of the body's own; undefined: its own. */
	pelt: Fur | undefined;
	/** Share of the body's second tip colour on a pelt, 0..1. */
	tips: number;
	/** Strength of its highlights; undefined: the usual one. */
	gloss: number | undefined;
	method: FurMethodName;
	/** Makes the light of a method of comparison; undefined: the fur's own light. */
	light: typeof furMethod | undefined;
}

interface Look {
	fur: Fur;
	gloss: number | undefined;
	/** Method of comparison that lights it, if any. */
	rival: FurMethod | undefined;
}

/** Coarseness of the shells in the first frame. */
const FIRST_COARSENESS = 4;

/** Seconds of a fade between looks; largest share of it in a frame, so that slow frames do not jump. */
const FADE_TIME = 0.6;
const MAX_FADE_STEP = 0.2;

export class Looks {
	#body: Fur | undefined;
	/** Furs made for this body so far, by pelt. */
	readonly #furs = new Map<Fur, Fur[]>();
	#looks: Look[] = [];
	/** Looks that are being faded out. */
	#leavingLooks: readonly Look[] = [];
	/** Furs of both: a list that frames would make anew. */
	#drawn: readonly Fur[] = [];
	/** True while the first picture is drawn. */
	#first = false;
	#fade: FurFade | undefined;
	#onFaded: () => void = () => {};
	readonly #methodOptions: FurMethodOptions;

	/** @param methodOptions renderer and lamp of the methods of comparison */
	constructor(methodOptions: FurMethodOptions) {
		this.#methodOptions = methodOptions;
	}

	/** The model's own fur, on which all looks stand, shown or not. */
	get body(): Fur | undefined {
		return this.#body;
	}

	/** States that any fur on show has beside dry and clean. */
	get states(): { wet: boolean; dirt: boolean } {
		const states = this.furs.map((fur) => fur.states);
		return { wet: states.some(({ wet }) => wet), dirt: states.some(({ dirt }) => dirt) };
	}

	/** Furs on show. */
	get furs(): Fur[] {
		return this.#looks.map(({ fur }) => fur);
	}

	/** Fur on the left, or on all of the picture. */
	get fur(): Fur | undefined {
		return this.#looks[0]?.fur;
	}

	/**
	 * Shows a body in one outfit, or in two side by side.
	 *
	 * @param view style of both
	 */
	show(body: Fur, outfits: readonly Outfit[], view: View): void {
		this.finishFade();
		if (body !== this.#body) this.clear();
		this.#body = body;
		const before = this.#looks;
		this.#setLooks(body, outfits, view);
		this.#showOnlyLooks(before);
		this.style(view);
	}

	/**
	 * Fades the body on show over to other outfits; `step` moves the fade on.
	 *
	 * @param outfits other than those on show
	 * @param fade makes the fade, at share 0
	 * @returns at the end of the fade
	 */
	fadeTo(
		outfits: readonly Outfit[],
		view: View,
		scene: Scene,
		fade: (from: readonly Fur[], to: readonly Fur[]) => FurFade,
	): Promise<void> {
		this.finishFade();
		const body = this.#body as Fur;
		this.#leavingLooks = this.#looks;
		this.#setLooks(body, outfits, view);
		for (const { fur, rival } of this.#looks) {
			fur.visible = true;
			rival?.apply();
		}
		this.style(view);
		this.#fade = fade(
			this.#leavingLooks.map(({ fur }) => fur),
			this.furs,
		);
		scene.add(this.#fade);
		return new Promise((resolve) => {
			this.#onFaded = resolve;
		});
	}

	/** Makes the furs of outfits without showing them. @param compile called with each of their furs, in its style */
	async prepare(outfits: readonly Outfit[], view: View, compile: (fur: Fur) => Promise<void>): Promise<void> {
		const body = this.#body as Fur;
		for (const [fur, { gloss }] of this.#fursOf(body, outfits)) {
			if (body !== this.#body) return;
			fur.visible = this.#looks.some((look) => look.fur === fur);
			style(fur, gloss, view);
			await compile(fur);
		}
	}

	/** Moves the fade on. @returns milliseconds until another frame is wanted: 0 at once, Infinity none */
	step(seconds: number): number {
		const fade = this.#fade;
		if (!fade) return Number.POSITIVE_INFINITY;
		fade.share += Math.min(seconds / FADE_TIME, MAX_FADE_STEP);
		if (fade.share > 1 - 1e-6) this.finishFade();
		return 0;
	}

	/** Ends the fade at once. */
	finishFade(): void {
		if (!this.#fade) return;
		this.#fade.dispose();
		this.#fade = undefined;
		const before = this.#leavingLooks;
		this.#leavingLooks = [];
		this.#listDrawn();
		this.#showOnlyLooks(before);
		this.#onFaded();
	}

	/** Furs of outfits on a body, in their order. */
	#fursOf(body: Fur, outfits: readonly Outfit[]): [fur: Fur, outfit: Outfit][] {
		const counts = new Map<Fur, number>();
		return outfits.map((outfit) => {
			const { pelt = body, tips } = outfit;
			const nth = counts.get(pelt) ?? 0;
			counts.set(pelt, nth + 1);
			return [this.#furOf(body, pelt, tips, nth), outfit];
		});
	}

	/** Makes the looks of a body, without showing them. */
	#setLooks(body: Fur, outfits: readonly Outfit[], view: View): void {
		this.#looks = this.#fursOf(body, outfits).map(([fur, { gloss, method, light }]) => {
			// Rivals copy the switches of the fur's own material: style that first.
			style(fur, gloss, view);
			return { fur, gloss, rival: light?.(fur, method, this.#methodOptions) };
		});
		this.#listDrawn();
	}

	#listDrawn(): void {
		this.#drawn = [...this.#looks, ...this.#leavingLooks].map(({ fur }) => fur);
	}

	/** Shows the present looks only, and frees those before. */
	#showOnlyLooks(before: readonly Look[]): void {
		// After the new ones are made: programs in use by both are not compiled again.
		for (const { rival } of before) rival?.dispose();
		for (const { rival } of this.#looks) rival?.apply();
		for (const fur of [...(this.#body ? [this.#body] : []), ...[...this.#furs.values()].flat()])
			fur.visible = this.#looks.some((look) => look.fur === fur);
		// Both cast the same shadow.
		this.#looks.forEach(({ fur }, i) => {
			fur.shells.castShadow = i === 0;
		});
	}

	/** Fur of a pelt on the body; the nth, as two looks may share a pelt. */
	#furOf(body: Fur, pelt: Fur, tips: number, nth: number): Fur {
		if (pelt === body && nth === 0) return body;
		const furs = this.#furs.get(pelt) ?? [];
		this.#furs.set(pelt, furs);
		const index = pelt === body ? nth - 1 : nth;
		const fur = furs[index] ?? dressFur(body, pelt, { tips });
		furs[index] = fur;
		return fur;
	}

	/** Styles hairs and shells of all looks by the view. */
	style(view: View): void {
		for (const { fur, gloss, rival } of this.#looks) {
			style(fur, gloss, view);
			// Fins know their own light only, and would be a seam around fur lit by another method.
			if (fur.fins) fur.fins.visible = (view.fins ?? true) && !rival;
		}
	}

	/**
	 * Shows the first fur of all with few shells and without fins, whose programs the first frame can spare; then by the
	 * view of that time.
	 *
	 * @param drawn draws a frame
	 */
	async showFirst(store: Store, drawn: () => Promise<void>): Promise<void> {
		const { shells, fins } = this.fur ?? {};
		if (!shells || store.get().shells) return drawn();
		this.#first = true;
		if (fins) fins.visible = false;
		await drawn();
		this.#first = false;
		this.style(store.get());
	}

	/** Moves all looks on in this motion and weather, and redraws maps of methods. @param still swing without motion */
	update(
		seconds: number,
		motion: FurMotion | undefined,
		weather: FurWeather | undefined,
		still: Texture | undefined,
	): void {
		for (const fur of this.#drawn) {
			fur.motion = motion;
			fur.weather = weather;
			if (!motion) fur.swing = still;
		}
		updateFurs(this.#drawn, seconds);
	}

	/** Spaces the shells of all furs. */
	space({ coarseness, merging }: ShellSpacing): void {
		for (const { shells } of this.#drawn) {
			shells.coarseness = this.#first ? FIRST_COARSENESS : coarseness;
			shells.merging = merging;
		}
	}

	/** Fetches the states of the furs on show. */
	async loadStates(): Promise<void> {
		await Promise.all(this.furs.map((fur) => fur.loadStates()));
	}

	/** @param share of the picture's width where the second look begins; without a second one nothing is cut */
	setSplit(share: number): void {
		const [left, right] = this.#looks;
		if (left) left.fur.clip = right && { from: 0, to: share };
		if (right) right.fur.clip = { from: share, to: 1 };
	}

	/** Call while the context is lost: frees what no scene holds, maps of methods and unused materials. */
	loseContext(): void {
		this.finishFade();
		for (const { fur, rival } of this.#looks) {
			if (!rival) continue;
			rival.dispose();
			fur.material.dispose();
			rival.apply();
		}
	}

	/** Frees all looks; call before the body is disposed of. */
	clear(): void {
		this.finishFade();
		for (const { rival } of this.#looks) rival?.dispose();
		this.#looks = [];
		this.#listDrawn();
		for (const fur of [...this.#furs.values()].flat()) fur.dispose();
		this.#furs.clear();
		this.#body = undefined;
	}
}
