/** A model in memory, as the stage shows it. */

import { type Box3, Mesh, type Object3D } from 'three';
import type { Fur } from '../fur/index.ts';
import type { ClipPlayer } from './clips/ClipPlayer.ts';

export interface Model {
	object: Object3D;
	/** undefined for a file without fur that this page can grow */
	fur: Fur | undefined;
	/** version of its fur, where that is newer than those that this page knows */
	newer?: string;
	/** undefined for a model without clips */
	clips?: ClipPlayer;
	/** box around the skin, in the whole of the chosen clip */
	box: Box3;
	/** radius of the sphere around the box's centre that holds the skin */
	readonly radius: number;
	/** first view and light of a picture that is relit; undefined for a body */
	first?: { camera: [number, number, number]; light: [number, number, number] };
	dispose(): void;
}

/** Meshes beside skin and fur: eyes, noses and the like, wherever they hang. */
export function features(object: Object3D, { skin, shells }: Pick<Fur, 'skin' | 'shells'>): Mesh[] {
	const found: Mesh[] = [];
	const visit = (child: Object3D) => {
		if (child === skin || child === shells.parent) return;
		if (child instanceof Mesh) found.push(child);
		child.children.forEach(visit);
	};
	visit(object);
	return found;
}
