/** Square of fur without lapped patches: whole tiles side by side, lengths in tile widths. u runs along x, v against z. */

import { type BufferGeometry, Color, Mesh, MeshStandardMaterial, Object3D, PlaneGeometry, Vector3 } from 'three';
import { Fur, type FurShells } from '../fur/index.ts';

/** Squares per tile: the lights' moments are sums at their corners. */
const CELLS = 4;
/** Share of the roots' colour that the skin shows in the shadow of its fur. */
const SHADE = 0.35;

/** Flat square of tiles with the shells' attributes. @param tiles across; @param cells squares of the mesh across */
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
	/** Fur of the square, which can swing and get wet. */
	readonly fur: Fur;
	readonly shells: FurShells;
	readonly skin: Mesh<BufferGeometry, MeshStandardMaterial>;
	/** Length of the longest hairs. */
	readonly height: number;

	/** @param pelt any fur with this pelt; @param surface replaces the square of tiles */
	constructor(pelt: Pick<Fur, 'asset' | 'pelt' | 'ground'>, tiles: number, surface = tiled(tiles)) {
		super();
		this.height = pelt.asset.height;
		const asset = { ...pelt.asset, tiles: 1, length: this.height };
		const ground = { ...pelt.ground, colour: new Color(1, 1, 1), surface, placement: new Object3D(), quads: undefined };
		this.fur = new Fur(asset, pelt.pelt, ground, 'vertices');
		this.shells = this.fur.shells;
		this.shells.castShadow = this.shells.receiveShadow = false;
		const shade = new Color(...asset.ramp.root).multiplyScalar(SHADE);
		this.skin = new Mesh<BufferGeometry, MeshStandardMaterial>(
			new PlaneGeometry(tiles, tiles).rotateX(-Math.PI / 2),
			new MeshStandardMaterial({ color: shade }),
		);
		// The pelt's own skin may be in another scene.
		this.add(this.skin, this.shells);
	}

	/** Centre of the fur. */
	get middle(): Vector3 {
		return new Vector3(0, this.height / 2, 0).add(this.position);
	}
}
