/** Seconds from all shells to merged ones and back. */
const TIME = 0.4;

/** Way between all shells of the furs and merged ones, so that nothing pops; see `FurShells.merging`. */
export class Merging {
	share = 0;

	/** Goes on towards 0 or 1. @param elapsed seconds; @returns whether it is on the way */
	glide(to: 0 | 1, elapsed: number): boolean {
		const change = to - this.share;
		this.share += Math.sign(change) * Math.min(Math.abs(change), elapsed / TIME);
		return this.share !== to;
	}
}
