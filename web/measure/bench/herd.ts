/** Subject: many bodies in one herd, on a square lattice under one lamp. */

import { DirectionalLight, Matrix4, Scene, Vector3 } from 'three';
import { FurInstances } from '../../fur/index.ts';
import type { Row } from './results.ts';
import { boundsOf, IRRADIANCE, lampAt, type Subject } from './subjects.ts';
import type { Torus } from './tori.ts';

/** Distance of two bodies' middles, radii of a body with its fur. */
const SPACING = 2.05;

/** @param row PTM with fins under a moving lamp; @param count number of bodies, a square number */
export function makeHerd(row: Row, torus: Torus, count: number): Subject {
	const { fur } = torus;
	const { center, radius } = boundsOf(torus);
	const scene = new Scene();
	const lamp = new DirectionalLight(0xffffff, IRRADIANCE);
	scene.add(lamp, lamp.target);
	const direction = new Vector3();
	const turn = (step: number) => {
		lamp.position.copy(lampAt(step, 0, direction));
	};
	turn(0);

	const herd = new FurInstances(fur, count, [row.shells]);
	herd.height = row.height;
	const side = Math.sqrt(count);
	const place = new Matrix4();
	for (let i = 0; i < count; i++) {
		const at = (step: number) => (step - (side - 1) / 2) * SPACING * radius;
		place.makeTranslation(at(i % side) - center.x, -center.y, at(Math.floor(i / side)) - center.z);
		herd.setMatrixAt(i, place);
	}
	scene.add(herd);
	return {
		row,
		scene,
		// The lattice, from its middle to its rim, over one body.
		reach: 1 + ((side - 1) / 2) * SPACING,
		turn,
		prepare() {
			// Herds of one fur share its number of shells.
			fur.shells.shellCount = row.shells;
			fur.update(0);
		},
		dispose() {
			herd.dispose();
			lamp.dispose();
		},
	};
}
