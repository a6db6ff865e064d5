/** Fur that follows an attachment. */
export interface Follower {
	/** Called when the picture changes. */
	follow(): void;
	/** Called when the attachment is disposed of. */
	detach(): void;
}

/**
 * Base of motion and weather. Its constructor attaches it to a fur, `dressed.motion = motion` to other furs of the body, and
 * `Fur.update` advances it.
 */
export abstract class FurAttachment {
	readonly #followers = new Set<Follower>();

	/**
	 * Advances by a frame.
	 *
	 * @param seconds since the last call
	 * @returns whether the picture changes
	 * @internal
	 */
	abstract update(seconds: number): boolean;

	/** Adds a fur. @internal */
	join(follower: Follower): void {
		this.#followers.add(follower);
	}

	/** Removes a fur. @internal */
	leave(follower: Follower): void {
		this.#followers.delete(follower);
	}

	/** Let attached furs show the present state. @internal */
	protected show(): void {
		for (const follower of this.#followers) follower.follow();
	}

	/** Frees its resources and leaves all furs that it was attached to as baked. */
	dispose(): void {
		for (const follower of [...this.#followers]) follower.detach();
	}
}
