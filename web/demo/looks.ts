/** How the body on show looks: which pelt it wears, by which method that is lit; one way, or two side by side. */

import type { DirectionalLight, Texture, WebGLRenderer } from 'three';
import { dress, type Fur, type FurMethod, type FurWeather, furMethod, type MethodName } from '../fur/index.ts';
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
/** Strength of most furs' highlights, and of light from behind. */
const usualGloss = 0.5;
const backlight = 6;

export class Looks {
	#body: Fur | undefined;
	/** What has been put on this body so far, by pelt: the body itself, and what lies over it. */
	readonly #worn = new Map<Fur, Fur[]>();
	#looks: Look[] = [];

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
		if (body !== this.#body) this.strip();
		this.#body = body;
		const before = this.#looks;
		const counts = new Map<Fur, number>();
		this.#looks = [];
		for (const { pelt = body, tips, gloss, method } of outfits) {
			const nth = counts.get(pelt) ?? 0;
			counts.set(pelt, nth + 1);
			const fur = this.#on(body, pelt, tips, nth);
			// Rivals take the switches of the fur's own material as they stand, so these come first.
			style(fur, gloss, view);
			this.#looks.push({ fur, gloss, rival: method === 'ptm' ? undefined : furMethod(method, fur) });
		}
		// After the new ones, so that programs which both have in use are not compiled again.
		for (const { rival } of before) rival?.dispose();
		for (const { rival } of this.#looks) rival?.wear();
		for (const fur of [body, ...[...this.#worn.values()].flat()])
			fur.visible = this.#looks.some((look) => look.fur === fur);
		// Both cast the same shadow.
		this.#looks.forEach(({ fur }, i) => {
			fur.shells.castShadow = i === 0;
		});
		this.style(view);
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
		for (const { fur } of this.#looks) {
			fur.swing = swing;
			fur.weather = weather;
		}
	}

	/** Fetches the states of the furs on show. */
	async loadStates(): Promise<void> {
		await Promise.all(this.#looks.map(({ fur }) => fur.loadStates()));
	}

	/** To be called before every frame. */
	before(renderer: WebGLRenderer, key: DirectionalLight): void {
		for (const { rival } of this.#looks) rival?.before(renderer, key);
	}

	/** @param share of the picture's width where the second look begins; without a second one nothing is cut */
	cut(share: number): void {
		const [left, right] = this.#looks;
		if (left) left.fur.clip = right && { from: 0, to: share };
		if (right) right.fur.clip = { from: share, to: 1 };
	}

	/** To be called while the context is lost: frees what no scene holds, the maps of methods and materials that are not worn. */
	forget(): void {
		for (const { fur, rival } of this.#looks) {
			if (!rival) continue;
			rival.dispose();
			fur.material.dispose();
			rival.wear();
		}
	}

	/** Takes all off the body; to be called before it is disposed of. */
	strip(): void {
		for (const { rival } of this.#looks) rival?.dispose();
		this.#looks = [];
		for (const fur of [...this.#worn.values()].flat()) fur.dispose();
		this.#worn.clear();
		this.#body = undefined;
	}
}

function style(fur: Fur, gloss = usualGloss, { shells, length = 1, density = 1, colour }: View): void {
	const { material } = fur.shells;
	material.gloss = gloss;
	material.backlight = backlight;
	material.density = density;
	fur.length = length;
	if (shells) fur.shells.shellCount = shells;
	else fur.shells.automatic = true;
	paint(fur, colour);
}
