/** Lines of the visible lamp, at distance 1: the horizon of its sphere, and the rail on which it rises. */

import { Line2 } from 'three/addons/lines/Line2.js';
import { LineGeometry } from 'three/addons/lines/LineGeometry.js';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { additive, warm } from './lamp.ts';

/** Angle of the rail to both sides of the lamp, radians. */
const REACH = 0.9;

export class LampLines {
	readonly horizon = arc(0, 2 * Math.PI, () => 0.07);
	readonly rail = arc(-REACH, REACH, (angle) => 0.3 * Math.cos((angle / REACH) * (Math.PI / 2)) ** 2);

	constructor() {
		this.horizon.rotation.x = Math.PI / 2;
	}
}

/** Circle arc in the x-y plane; brightness by angle, black is invisible. */
function arc(from: number, to: number, brightness: (angle: number) => number): Line2 {
	const steps = 96;
	const positions: number[] = [];
	const colours: number[] = [];
	for (let i = 0; i <= steps; i++) {
		const angle = from + ((to - from) * i) / steps;
		positions.push(Math.cos(angle), Math.sin(angle), 0);
		colours.push(...warm.map((part) => part * brightness(angle)));
	}
	const linewidth = 1.2 * Math.min(devicePixelRatio, 2);
	// One dash without end: dashed segments have no caps, which would lie over each other like beads.
	const whole = { dashed: true, dashSize: 1e6, gapSize: 0 };
	const material = new LineMaterial({ linewidth, vertexColors: true, ...whole, ...additive });
	return new Line2(new LineGeometry().setPositions(positions).setColors(colours), material).computeLineDistances();
}
