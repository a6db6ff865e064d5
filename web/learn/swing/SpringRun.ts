/** Release of a hair's tip: solution, exact steps and Euler's steps over one time axis. */

import { eulerPath, exactPath, farthest, type Oscillator, truth } from './oscillator.ts';

/** Length of the time axis. */
export const SECONDS = 2;
export const FIRST_RATE = 60;

export class SpringRun {
	readonly spring: Oscillator = { frequency: 3, damping: 0.15, rest: 0.1, from: 0.7 };
	/** Steps per second. */
	rate = FIRST_RATE;
	/** Seconds since the release. */
	time = 0.3;
	exact: number[] = [];
	euler: number[] = [];

	/** Recomputes both paths. @returns largest distance of each from the solution, lengths of the hair */
	compute(): { exact: number; euler: number } {
		const { spring } = this;
		const dt = 1 / this.rate;
		this.exact = exactPath(spring, dt, SECONDS);
		this.euler = eulerPath(spring, dt, SECONDS);
		return { exact: farthest(this.exact, spring, dt), euler: farthest(this.euler, spring, dt) };
	}

	/** Present displacement by the solution, exact steps and Euler's steps. */
	tips(): [number, number, number] {
		const { exact, euler } = this;
		const step = Math.floor(this.time * this.rate + 1e-6);
		return [truth(this.spring, this.time), exact[step] ?? exact.at(-1) ?? 0, euler[step] ?? euler.at(-1) ?? 0];
	}
}
