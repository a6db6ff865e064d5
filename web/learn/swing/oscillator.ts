/** Path of one hair's tip on its spring: the solution, the library's exact steps, and Euler's. */

import { springOf } from '../../fur/reference.ts';

export interface Oscillator {
	/** Frequency without damping, Hz. */
	frequency: number;
	/** ζ, 0..1. */
	damping: number;
	/** Rest position, lengths of the hair. */
	rest: number;
	/** Start position. */
	from: number;
}

/** Position and velocity of a tip, in lengths of the hair and seconds. */
interface Tip {
	x: number;
	v: number;
}

const omega = ({ frequency }: Oscillator): number => 2 * Math.PI * frequency;

/** x at a time by amplitude and phase of the fading cosine, independent of the step. */
export function truth(spring: Oscillator, time: number): number {
	const { damping, rest, from } = spring;
	const fade = damping * omega(spring);
	const turn = omega(spring) * Math.sqrt(1 - damping * damping);
	const phase = Math.atan2(fade, turn);
	return rest + ((from - rest) / Math.cos(phase)) * Math.exp(-fade * time) * Math.cos(turn * time - phase);
}

/** Path by exact steps of `dt` seconds, from the start position. */
export function exactPath(spring: Oscillator, dt: number, seconds: number): number[] {
	const { xx, xv, vx, vv } = springOf(spring.frequency, spring.damping, dt);
	return walk(spring, dt, seconds, ({ x, v }) => {
		const y = x - spring.rest;
		return { x: spring.rest + xx * y + xv * v, v: vx * y + vv * v };
	});
}

/** Path by Euler's steps, with the slope at the beginning of each. */
export function eulerPath(spring: Oscillator, dt: number, seconds: number): number[] {
	const w = omega(spring);
	return walk(spring, dt, seconds, ({ x, v }) => ({
		x: x + v * dt,
		v: v - (2 * spring.damping * w * v + w * w * (x - spring.rest)) * dt,
	}));
}

function walk(spring: Oscillator, dt: number, seconds: number, step: (tip: Tip) => Tip): number[] {
	const path = [spring.from];
	let tip = { x: spring.from, v: 0 };
	// A millionth: 2 / (1 / 60) may be less than 120.
	for (let n = 1; n * dt <= seconds * (1 + 1e-6); n++) {
		tip = step(tip);
		path.push(tip.x);
	}
	return path;
}

/** Largest distance of a path's points from the solution. */
export function farthest(path: readonly number[], spring: Oscillator, dt: number): number {
	return Math.max(...path.map((x, i) => Math.abs(x - truth(spring, i * dt))));
}

/** The longest step, in seconds, with which Euler's path does not grow: |1 + (−δ ± iω_d)·dt| = 1. */
export function eulerLimit(spring: Oscillator): number {
	return (2 * spring.damping) / omega(spring);
}
