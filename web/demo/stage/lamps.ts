/** Lamps beside the dragged one: softer, each of its own colour, all turning with it. */

import { DirectionalLight, Group, MathUtils, Object3D, type Vector3 } from 'three';

/**
 * Lamps in the order in which they are lit: degrees away from the dragged lamp, degrees around its ray, colour, strength
 * over the dragged one's. The first two are a rim and a fill light; the others follow in opposite pairs.
 */
const LAMPS: [away: number, around: number, colour: string, strength: number][] = [
	[118, -20, '#7fa8ff', 0.5],
	[96, 150, '#ff9a6b', 0.36],
	[150, 80, '#b58cff', 0.45],
	[84, -110, '#63d3c6', 0.26],
	[128, 200, '#ff7f9e', 0.36],
	[70, 60, '#ffe08a', 0.2],
	[140, -70, '#79e08c', 0.32],
];

/** Factor of all strengths per further lamp: pictures stay about as bright. */
const DIMMING = 0.93;

export class Lamps extends Group {
	readonly #power: number;

	/** @param power linear colour times irradiance of a white lamp of strength 1 */
	constructor(power: number) {
		super();
		this.#power = power;
	}

	/** Number of lamps, the dragged one included. */
	get lit(): number {
		return this.children.length + 1;
	}

	set lit(count: number) {
		if (count === this.lit) return;
		this.clear();
		const share = DIMMING ** (count - 1);
		LAMPS.slice(0, count - 1).forEach(([away, around, colour, strength]) => {
			const lamp = new DirectionalLight(colour, this.#power * strength * share);
			lamp.position.setFromSphericalCoords(1, MathUtils.degToRad(away), MathUtils.degToRad(around));
			this.add(lamp);
		});
	}

	/** Strength of the dragged lamp over its strength alone. */
	get share(): number {
		return DIMMING ** this.children.length;
	}

	/**
	 * Turns with the dragged lamp by the shortest way from straight above: the only jump is straight below.
	 *
	 * @param direction unit vector to the dragged lamp, world axes
	 */
	turn(direction: Vector3): void {
		this.quaternion.setFromUnitVectors(Object3D.DEFAULT_UP, direction);
	}
}
