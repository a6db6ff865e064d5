/** A square of fur with nothing lapped: whole tiles side by side, all lengths in tile widths. u runs along x, v against z. */

import { type BufferGeometry, Color, Mesh, MeshStandardMaterial, Object3D, PlaneGeometry, Vector3 } from 'three';
import { Fur, type FurShells } from '../fur/index.ts';

/** Squares per tile: the lights' moments are sums at their corners. */
const CELLS = 4;
/** What is left of the roots' colour on the skin, in the shadow of all the fur above it. */
const SHADE = 0.35;

/** A flat square of tiles with the attributes that shells need. @param tiles across; @param cells squares of the mesh across */
export function tiled(tiles: number, cells = Math.max(1, Math.round(tiles * CELLS))): PlaneGeometry {
	const square = new PlaneGeometry(tiles, tiles, cells, cells).rotateX(-Math.PI / 2);
	const uv = square.getAttribute('uv');
	for (let i = 0; i < uv.count; i++) uv.setXY(i, uv.getX(i) * tiles, uv.getY(i) * tiles);
	const tangent = uv.clone();
	tangent.itemSize = 4;
	tangent.array = new Float32Array(uv.count * 4).map((_, i) => (i % 4 === 0 || i % 4 === 3 ? 1 : 0));
	square.setAttribute('tangent', tangent);
	return square;
}

export class FurPatch extends Object3D {
	/** As on any body: it can swing and get wet. */
	readonly fur: Fur;
	readonly shells: FurShells;
	readonly skin: Mesh<BufferGeometry, MeshStandardMaterial>;
	/** Longest hairs. */
	readonly height: number;

	/** @param pelt any fur of it; @param surface instead of a square of so many tiles */
	constructor(pelt: Pick<Fur, 'asset' | 'pelt' | 'ground'>, tiles: number, surface = tiled(tiles)) {
		super();
		this.height = pelt.asset.height;
		const asset = { ...pelt.asset, tiles: 1, length: this.height };
		const ground = { ...pelt.ground, colour: new Color(1, 1, 1), surface, placement: new Object3D(), quads: undefined };
		this.fur = new Fur(asset, pelt.pelt, ground, () => surface.dispose());
		this.shells = this.fur.shells;
		this.shells.castShadow = this.shells.receiveShadow = false;
		const shade = new Color(...asset.ramp.root).multiplyScalar(SHADE);
		this.skin = new Mesh<BufferGeometry, MeshStandardMaterial>(
			new PlaneGeometry(tiles, tiles).rotateX(-Math.PI / 2),
			new MeshStandardMaterial({ color: shade }),
		);
		// Beside the pelt's own skin the shells would be in another scene.
		this.add(this.skin, this.shells);
	}

	/** Middle of the fur. */
	get middle(): Vector3 {
		return new Vector3(0, this.height / 2, 0).add(this.position);
	}
}
