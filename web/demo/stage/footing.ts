/** Where a furry body stands. */

import { Matrix4, Vector3 } from 'three';
import type { Model } from './model.ts';

/** Share of the hairs' length that the body's weight leaves below the skin. */
const PRESSED = 0.5;

const vertex = new Vector3();
const toModel = new Matrix4();

/**
 * Height of the ground below a body: hairs under its feet are pressed to half of their length.
 *
 * @param model as it stands in its file
 * @returns world units; the lowest point of a body without fur
 */
export function footing({ object, fur, box }: Pick<Model, 'object' | 'fur' | 'box'>): number {
	const position = fur?.shells.geometry.getAttribute('position');
	if (!fur || !position) return box.min.y;
	const share = fur.shells.geometry.getAttribute('_fur');
	object.updateWorldMatrix(true, true);
	toModel.copy(object.matrixWorld).invert().multiply(fur.shells.matrixWorld);
	let lowest = box.min.y;
	for (let i = 0; i < position.count; i++) {
		const { y } = vertex.fromBufferAttribute(position, i).applyMatrix4(toModel);
		lowest = Math.min(lowest, y - PRESSED * fur.shells.furLength * (share ? share.getY(i) : 1));
	}
	return lowest;
}
