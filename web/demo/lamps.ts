/** The lamps beside the one that is dragged: softer, each of a colour of its own, all of them turning with it. */

import { DirectionalLight, Group, MathUtils, Object3D, type Vector3 } from 'three';

/** Lamps in all, the dragged one among them. */
export const maxLamps = 8;

/**
 * Where they stand from the dragged lamp: degrees away from it, degrees around its ray; their colours; their strength
 * beside it. The first ones make a rim and a fill by themselves, more of them go round in opposite pairs.
 */
const places: [away: number, around: number, colour: string, strength: number][] = [
	[118, -20, '#7fa8ff', 0.5],
	[96, 150, '#ff9a6b', 0.36],
	[150, 80, '#b58cff', 0.45],
	[84, -110, '#63d3c6', 0.26],
	[128, 200, '#ff7f9e', 0.36],
	[70, 60, '#ffe08a', 0.2],
	[140, -70, '#79e08c', 0.32],
];

/** The dragged lamp's share of its strength alone, per lamp beside it: pictures stay about as bright. */
const dimming = 0.93;

export class Lamps extends Group {
	readonly #power: number;

	/** @param power linear colour times irradiance of a white lamp of strength 1 */
	constructor(power: number) {
		super();
		this.#power = power;
	}

	/** All lamps, the dragged one among them. */
	get lit(): number {
		return this.children.length + 1;
	}

	set lit(count: number) {
		if (count === this.lit) return;
		this.clear();
		const share = dimming ** (count - 1);
		places.slice(0, count - 1).forEach(([away, around, colour, strength]) => {
			const lamp = new DirectionalLight(colour, this.#power * strength * share);
			lamp.position.setFromSphericalCoords(1, MathUtils.degToRad(away), MathUtils.degToRad(around));
			this.add(lamp);
		});
	}

	/** What the dragged lamp has of its strength alone. */
	get share(): number {
		return dimming ** this.children.length;
	}

	/**
	 * Turns them with the dragged lamp by the shortest way from straight above, so that nothing jumps but where that one
	 * is straight below.
	 *
	 * @param direction unit vector to the dragged lamp, world axes
	 */
	turn(direction: Vector3): void {
		this.quaternion.setFromUnitVectors(Object3D.DEFAULT_UP, direction);
	}
}
