import type { Texture } from 'three';
import type { FurAttachment } from './FurAttachment.ts';

/** Motion: swing of the hairs. */
type Motion = FurAttachment & { readonly swing: Texture | undefined };

/** Fur that bends: a `Fur`. */
interface BentFur<M> {
	readonly material: { swing: Texture | undefined };
	swing: Texture | undefined;
	motion: M | undefined;
}

/** Swing of one fur's hairs, by attached motion or by hand. */
export class Bending<M extends Motion> {
	readonly #fur: BentFur<M>;
	#motion: M | undefined;
	readonly #follower = {
		follow: () => {
			this.#fur.swing = this.#motion?.swing;
		},
		detach: () => {
			this.#fur.motion = undefined;
		},
	};
	readonly #straighten = (): void => {
		this.#fur.swing = undefined;
	};

	constructor(fur: BentFur<M>) {
		this.#fur = fur;
	}

	/** Attached motion, if any. */
	get motion(): M | undefined {
		return this.#motion;
	}

	set motion(motion: M | undefined) {
		if (motion === this.#motion) return;
		this.#motion?.leave(this.#follower);
		this.#motion = motion;
		motion?.join(this.#follower);
		this.#fur.swing = motion?.swing;
	}

	/** Show a texture until it is disposed of. */
	show(texture: Texture | undefined): void {
		const { material } = this.#fur;
		material.swing?.removeEventListener('dispose', this.#straighten);
		texture?.addEventListener('dispose', this.#straighten);
		material.swing = texture;
	}
}
