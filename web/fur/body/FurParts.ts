import { Object3D } from 'three';

/** Owner of parts: a fur. */
export interface PartsOwner {
	/** Body beside the parts. */
	readonly skin: Object3D;
	/** Called when the world matrices of the parts have been updated. */
	follow(): void;
	/**
	 * Called when a copy of the parts, empty so far, stands beside what may be a copy of the skin.
	 *
	 * @param candidate at the skin's place among the copies
	 */
	copyTo(parts: FurParts, candidate: Object3D | undefined): void;
}

/** Group of what is drawn of a fur. Copied together with the body, it becomes a fur of the body's copy. */
export class FurParts extends Object3D {
	/** Set by the fur. */
	owner: PartsOwner | undefined;

	constructor() {
		super();
		this.name = 'fur of a body';
	}

	override updateMatrixWorld(force?: boolean): void {
		super.updateMatrixWorld(force);
		this.owner?.follow();
	}

	/** Copies the placement; the rest follows when the copy is added to its parent, as three's own `clone` does. */
	override clone(_recursive?: boolean): this {
		const copy = new FurParts().copy(this, false);
		const { owner, parent } = this;
		const place = owner && parent ? parent.children.indexOf(owner.skin) : -1;
		const grow = (): void => {
			copy.removeEventListener('added', grow);
			if (owner) owner.copyTo(copy, copy.parent?.children[place]);
		};
		copy.addEventListener('added', grow);
		return copy as this;
	}
}
