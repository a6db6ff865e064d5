/** The body below the fur: dark where fur shades it, its own colour where it is bare. */

import {
	BufferAttribute,
	type BufferGeometry,
	type Color,
	type Material,
	type Mesh,
	type MeshStandardMaterial,
} from 'three';

/** Fur shorter than this share of the longest begins to let the skin's own colour through. */
const SHORT = 1 / 8;

/**
 * How much fur stands on each vertex of the skin, 0..1, by the vertices of the shells at the same place.
 *
 * @param skin with positions in the shells' units, to the bit; so each has fur where the shells stand on another, simpler
 * surface and share no vertex with it
 * @returns undefined where fur is all over it
 */
export function furCover(skin: BufferGeometry, shells: BufferGeometry): Float32Array | undefined {
	const fur = shells.getAttribute('_fur');
	const [places, stands] = [skin.getAttribute('position'), shells.getAttribute('position')];
	const key = (position: typeof places, i: number) => [position.getX(i), position.getY(i), position.getZ(i)].join();
	const cover = new Map<string, number>();
	for (let i = 0; i < stands.count; i++) {
		const share = fur ? fur.getX(i) * Math.min(fur.getY(i) / SHORT, 1) : 1;
		const at = key(stands, i);
		cover.set(at, (cover.get(at) ?? 0) + share);
	}
	const found = Array.from({ length: places.count }, (_, i) => cover.get(key(places, i)));
	if (found.every((share) => share === undefined)) return undefined;
	const shares = Float32Array.from(found, (share) => Math.min(share ?? 0, 1));
	return shares.every((share) => share > 0.99) ? undefined : shares;
}

/**
 * Dresses a piece of the skin in a copy of its material that is `shade` times as bright under fur.
 *
 * @param cover as from `furCover`
 * @returns the copy
 */
export function shadeSkin(piece: Mesh, shade: Color, cover: Float32Array | undefined): Material {
	const own = piece.material as MeshStandardMaterial;
	const dark = own.clone();
	const before = piece.geometry.getAttribute('color');
	if (cover) {
		const shades = shade.toArray();
		const colours = Float32Array.from({ length: cover.length * 3 }, (_, i) => {
			const [vertex, channel] = [Math.floor(i / 3), i % 3];
			const factor = 1 + ((shades[channel] ?? 1) - 1) * (cover[vertex] ?? 1);
			return factor * (before && own.vertexColors ? before.getComponent(vertex, channel) : 1);
		});
		piece.geometry.setAttribute('color', new BufferAttribute(colours, 3));
		dark.vertexColors = true;
	} else {
		dark.color?.multiply(shade);
	}
	piece.material = dark;
	return dark;
}
