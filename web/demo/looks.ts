/** How the body on show looks: which pelt it wears, by which method that is lit; one way, or two side by side. */

import type { Camera, DirectionalLight, Scene, Texture, WebGLRenderer } from 'three';
import {
	dress,
	type Fur,
	type FurFade,
	type FurMethod,
	type FurWeather,
	furMethod,
	type MethodName,
} from '../fur/index.ts';
import type { View } from './address.ts';
import { paint } from './colours.ts';

export interface Outfit {
	/** Instead of the body's own; undefined: that. */
	pelt: Fur | undefined;
	/** How far the body's second tip colour shows on a pelt, 0..1. */
	tips: number;
	/** Strength of its highlights; undefined: as of most. */
	gloss: number | undefined;
	method: MethodName;
}

interface Look {
	fur: Fur;
	gloss: number | undefined;
	/** Lit by another method than its own. */
	rival: FurMethod | undefined;
}

/** Of the first shells over what looks best. */
const coarse = 4;
/** Strength of most furs' highlights, and of light from behind: as bright as traced hairs are, see pelt/README.md. */
export const usualLook = { gloss: 0.25, backlight: 40 };

/** Seconds in which one look goes over into another, and the most of it that a frame takes: slow ones make no jump. */
const fading = 0.6;
const longest = 0.2;

export class Looks {
	#body: Fur | undefined;
	/** What has been put on this body so far, by pelt: the body itself, and what lies over it. */
	readonly #worn = new Map<Fur, Fur[]>();
	#looks: Look[] = [];
	/** Those that go, as long as they are still seen. */
	#leaving: readonly Look[] = [];
	#fade: FurFade | undefined;
	#finished: () => void = () => {};

	/** What all of them stand on: the model's own fur, worn or not. */
	get body(): Fur | undefined {
		return this.#body;
	}

	/** What states some of the furs on show have beside dry and clean. */
	get states(): { wet: boolean; dirt: boolean } {
		const furs = this.#looks.map(({ fur }) => fur.hasStates);
		return { wet: furs.some(({ wet }) => wet), dirt: furs.some(({ dirt }) => dirt) };
	}

	/** Fur on the left, or on all of the picture. */
	get fur(): Fur | undefined {
		return this.#looks[0]?.fur;
	}

	/**
	 * Has the body look like this: one outfit, or two that are to be shown side by side.
	 *
	 * @param view what holds for both
	 */
	wear(body: Fur, outfits: readonly Outfit[], view: View): void {
		this.finish();
		if (body !== this.#body) this.strip();
		this.#body = body;
		const before = this.#looks;
		this.#put(body, outfits, view);
		this.#leave(before);
		this.style(view);
	}

	/**
	 * The same on the body that is on show, going over to it little by little: `step` leads on from frame to frame.
	 *
	 * @param outfits others than those that are worn
	 * @param fade from the one to the other, share 0
	 * @returns when nothing else is seen
	 */
	exchange(
		outfits: readonly Outfit[],
		view: View,
		scene: Scene,
		fade: (from: readonly Fur[], to: readonly Fur[]) => FurFade,
	): Promise<void> {
		this.finish();
		const body = this.#body as Fur;
		this.#leaving = this.#looks;
		this.#put(body, outfits, view);
		for (const { fur, rival } of this.#looks) {
			fur.visible = true;
			rival?.wear();
		}
		this.style(view);
		const furs = (looks: readonly Look[]) => looks.map(({ fur }) => fur);
		this.#fade = fade(furs(this.#leaving), furs(this.#looks));
		scene.add(this.#fade);
		return new Promise((resolve) => {
			this.#finished = resolve;
		});
	}

	/** Puts outfits on without showing them. @param compile called with each of their furs, in its style */
	async prepare(outfits: readonly Outfit[], view: View, compile: (fur: Fur) => Promise<void>): Promise<void> {
		const body = this.#body as Fur;
		for (const [fur, { gloss }] of this.#furs(body, outfits)) {
			if (body !== this.#body) return;
			fur.visible = this.#looks.some((look) => look.fur === fur);
			style(fur, gloss, view);
			await compile(fur);
		}
	}

	/** Leads on what `exchange` began. @returns milliseconds until another frame is wanted: 0 at once, Infinity none */
	step(seconds: number): number {
		const fade = this.#fade;
		if (!fade) return Number.POSITIVE_INFINITY;
		fade.share += Math.min(seconds / fading, longest);
		if (fade.share > 1 - 1e-6) this.finish();
		return 0;
	}

	/** Has what `exchange` began be at its end. */
	finish(): void {
		if (!this.#fade) return;
		this.#fade.dispose();
		this.#fade = undefined;
		const before = this.#leaving;
		this.#leaving = [];
		this.#leave(before);
		this.#finished();
	}

	/** The furs of outfits on a body, in their order. */
	#furs(body: Fur, outfits: readonly Outfit[]): [fur: Fur, outfit: Outfit][] {
		const counts = new Map<Fur, number>();
		return outfits.map((outfit) => {
			const { pelt = body, tips } = outfit;
			const nth = counts.get(pelt) ?? 0;
			counts.set(pelt, nth + 1);
			return [this.#on(body, pelt, tips, nth), outfit];
		});
	}

	/** Makes the looks of a body: what it wears is not seen by that. */
	#put(body: Fur, outfits: readonly Outfit[], view: View): void {
		this.#looks = this.#furs(body, outfits).map(([fur, { gloss, method }]) => {
			// Rivals take the switches of the fur's own material as they stand, so these come first.
			style(fur, gloss, view);
			return { fur, gloss, rival: method === 'ptm' ? undefined : furMethod(method, fur) };
		});
	}

	/** Has the looks of now be seen alone. */
	#leave(before: readonly Look[]): void {
		// After the new ones, so that programs which both have in use are not compiled again.
		for (const { rival } of before) rival?.dispose();
		for (const { rival } of this.#looks) rival?.wear();
		for (const fur of [...(this.#body ? [this.#body] : []), ...[...this.#worn.values()].flat()])
			fur.visible = this.#looks.some((look) => look.fur === fur);
		// Both cast the same shadow.
		this.#looks.forEach(({ fur }, i) => {
			fur.shells.castShadow = i === 0;
		});
	}

	/** The nth fur of this pelt on the body. */
	#on(body: Fur, pelt: Fur, tips: number, nth: number): Fur {
		if (pelt === body && nth === 0) return body;
		const worn = this.#worn.get(pelt) ?? [];
		this.#worn.set(pelt, worn);
		const index = pelt === body ? nth - 1 : nth;
		let fur = worn[index];
		if (!fur) {
			fur = dress(body, pelt, { tips });
			worn[index] = fur;
		}
		return fur;
	}

	/** Gives all furs what the view says of hairs and shells. */
	style(view: View): void {
		for (const { fur, gloss, rival } of this.#looks) {
			style(fur, gloss, view);
			// Fins know their own light alone, and would be a seam around fur that is lit in another way.
			if (fur.fins) fur.fins.visible = (view.fins ?? true) && !rival;
		}
	}

	/**
	 * Shows the first fur of all with few shells and no fins, programs that its first frame does without; then as the view
	 * says by then.
	 *
	 * @param drawn has a frame drawn
	 */
	async grow(view: View, drawn: () => Promise<void>): Promise<void> {
		const { shells, fins } = this.fur ?? {};
		if (!shells || view.shells) return drawn();
		shells.coarseness = coarse;
		if (fins) fins.visible = false;
		await drawn();
		shells.coarseness = 1;
		this.style(view);
	}

	/** Has them move and be stained alike. @param swing of the hairs' tips; undefined: at rest */
	live(swing: Texture | undefined, weather: FurWeather | undefined): void {
		for (const { fur } of [...this.#looks, ...this.#leaving]) {
			fur.swing = swing;
			fur.weather = weather;
		}
	}

	/** Fetches the states of the furs on show. */
	async loadStates(): Promise<void> {
		await Promise.all(this.#looks.map(({ fur }) => fur.loadStates()));
	}

	/** To be called before every frame. */
	before(renderer: WebGLRenderer, scene: Scene, camera: Camera, key: DirectionalLight): void {
		for (const { rival } of [...this.#looks, ...this.#leaving]) rival?.before(renderer, key);
		this.#fade?.capture(renderer, scene, camera);
	}

	/** @param share of the picture's width where the second look begins; without a second one nothing is cut */
	cut(share: number): void {
		const [left, right] = this.#looks;
		if (left) left.fur.clip = right && { from: 0, to: share };
		if (right) right.fur.clip = { from: share, to: 1 };
	}

	/** To be called while the context is lost: frees what no scene holds, the maps of methods and materials that are not worn. */
	forget(): void {
		this.finish();
		for (const { fur, rival } of this.#looks) {
			if (!rival) continue;
			rival.dispose();
			fur.material.dispose();
			rival.wear();
		}
	}

	/** Takes all off the body; to be called before it is disposed of. */
	strip(): void {
		this.finish();
		for (const { rival } of this.#looks) rival?.dispose();
		this.#looks = [];
		for (const fur of [...this.#worn.values()].flat()) fur.dispose();
		this.#worn.clear();
		this.#body = undefined;
	}
}

function style(fur: Fur, gloss = usualLook.gloss, { shells, length = 1, density = 1, colour }: View): void {
	const { material } = fur.shells;
	material.gloss = gloss;
	material.backlight = usualLook.backlight;
	material.density = density;
	fur.length = length;
	if (shells) fur.shells.shellCount = shells;
	else fur.shells.automatic = true;
	paint(fur, colour);
}
