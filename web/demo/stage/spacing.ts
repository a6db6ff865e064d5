/** Seconds from all shells to merged ones and back. */
const TIME = 0.4;

/** Pixel ratio from which on hairs don't look woven where shells are 1.5 pixels apart. */
const SMALL_PIXELS = 1.5;

/** How shells are spaced; see `FurShells.coarseness` and `FurShells.merging`. */
export interface ShellSpacing {
	coarseness: number;
	merging: number;
}

/** Spacing of the furs' shells, on the way to what is wanted: between all and merged ones nothing pops. */
export class Spacing implements ShellSpacing {
	coarseness = 1;
	merging = 0;

	/** Goes on towards a spacing. @param elapsed seconds; @returns whether it is on the way */
	glide(to: ShellSpacing, elapsed: number): boolean {
		this.coarseness = devicePixelRatio < SMALL_PIXELS ? to.coarseness : 1;
		const change = to.merging - this.merging;
		this.merging += Math.sign(change) * Math.min(Math.abs(change), elapsed / TIME);
		return this.merging !== to.merging;
	}
}
