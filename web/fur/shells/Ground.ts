import type { BufferGeometry, Color, Object3D } from 'three';
import type { Roots } from '../body/roots/Roots.ts';
import type { Skin } from '../body/skin/Skin.ts';
import type { growFins } from './fins/growFins.ts';

/** Surfaces of a body that fur is drawn on. */
export interface Ground {
	skin: Skin;
	/** Picture of the skin's colours below the hairs; undefined: vertices have them. */
	roots?: Roots | undefined;
	/** Base colour of the model, which multiplies the fur's. */
	colour: Color;
	/** Geometry below the shells, the shells' node, and the quads of the fins. */
	surface: BufferGeometry;
	placement: Object3D;
	quads: BufferGeometry | undefined;
	/** Node of the quads; its axes may differ from the shells'. */
	quadPlacement: Object3D | undefined;
	/** Factor of the fins' second texture coordinate that makes it 1 at the tips. */
	finHeights: number;
	/** Code of the fins, for bodies that have some. */
	growFins?: typeof growFins | undefined;
}
