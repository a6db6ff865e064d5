/** A model in memory, as the stage shows it. */

import type { Box3, Object3D } from 'three';
import type { Fur } from '../../fur/index.ts';

export interface Model {
	object: Object3D;
	/** undefined for a file without fur that this page can grow */
	fur: Fur | undefined;
	/** version of its fur, where that is newer than those that this page knows */
	newer?: string;
	/** box around the skin */
	box: Box3;
	/** radius of the sphere around the box's centre that holds the skin */
	radius: number;
	dispose(): void;
}
