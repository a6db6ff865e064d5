/** Fur cover of each vertex of the skin. */

import type { BufferGeometry } from 'three';

/** Fur shorter than this share of the longest begins to let the skin's own colour through. */
const SHORT = 1 / 8;
/** Share of the shells' places that are vertices of the skin, where shells stand on the skin itself. */
const SAME = 0.9;
/** Distance from the shells' nearest vertex beyond which skin is bare where shells stand on a simpler surface, mean spacings. */
const NEAR = 2;

type Attribute = ReturnType<BufferGeometry['getAttribute']>;

const placeOf = (position: Attribute, i: number) => [position.getX(i), position.getY(i), position.getZ(i)] as const;

/** Whether shells stand on the skin's own vertices; else their surface is a simpler one. */
export function standsOn(skins: readonly BufferGeometry[], shells: BufferGeometry): boolean {
	const places = new Set<string>();
	for (const { attributes } of skins)
		for (let i = 0; i < (attributes.position?.count ?? 0); i++)
			places.add(placeOf(attributes.position as Attribute, i).join());
	const stands = shells.getAttribute('position');
	let met = 0;
	for (let i = 0; i < stands.count; i++) if (places.has(placeOf(stands, i).join())) met++;
	return met >= SAME * stands.count;
}

/**
 * Fur cover of each vertex of the skin, 0..1, by the shells' vertices at the same place.
 *
 * @param skin with positions in the shells' units, to the bit
 * @param apart whether shells stand on another, simpler surface: the nearest of their vertices counts
 * @returns undefined where fur covers all of it, or where no shell is near
 */
export function furCover(skin: BufferGeometry, shells: BufferGeometry, apart = false): Float32Array | undefined {
	const fur = shells.getAttribute('_fur');
	const [places, stands] = [skin.getAttribute('position'), shells.getAttribute('position')];
	const cover = new Map<string, number>();
	for (let i = 0; i < stands.count; i++) {
		const share = fur ? fur.getX(i) * Math.min(fur.getY(i) / SHORT, 1) : 1;
		const at = placeOf(stands, i).join();
		cover.set(at, (cover.get(at) ?? 0) + share);
	}
	const near = apart ? nearest(shells, cover) : undefined;
	const found = Array.from({ length: places.count }, (_, i) => {
		const at = placeOf(places, i);
		return cover.get(at.join()) ?? near?.(at);
	});
	if (found.every((share) => share === undefined)) return undefined;
	const shares = Float32Array.from(found, (share) => Math.min(share ?? 0, 1));
	return shares.every((share) => share > 0.99) ? undefined : shares;
}

type Place = readonly [x: number, y: number, z: number];

/** Looks up the cover of the nearest place of the shells; undefined where none is near. */
function nearest(shells: BufferGeometry, cover: ReadonlyMap<string, number>): (at: Place) => number | undefined {
	const reach = NEAR * spacing(shells);
	const cells = new Map<string, { at: Place; share: number }[]>();
	const cellOf = (at: Place) => at.map((x) => Math.floor(x / reach)) as [number, number, number];
	for (const [key, share] of cover) {
		const at = key.split(',').map(Number) as unknown as Place;
		const cell = cellOf(at).join();
		cells.set(cell, [...(cells.get(cell) ?? []), { at, share }]);
	}
	const offsets = [-1, 0, 1];
	return (at) => {
		const [x, y, z] = cellOf(at);
		let [best, found] = [reach, undefined as number | undefined];
		for (const i of offsets)
			for (const j of offsets)
				for (const k of offsets)
					for (const other of cells.get([x + i, y + j, z + k].join()) ?? []) {
						const far = Math.hypot(at[0] - other.at[0], at[1] - other.at[1], at[2] - other.at[2]);
						if (far < best) [best, found] = [far, other.share];
					}
		return found;
	};
}

/** Mean length of the edges of a mesh. */
function spacing({ index, attributes }: BufferGeometry): number {
	const position = attributes.position as Attribute;
	const corner = (i: number) => placeOf(position, index ? index.getX(i) : i);
	const corners = index?.count ?? position.count;
	let sum = 0;
	for (let i = 0; i + 2 < corners; i += 3) {
		const [a, b] = [corner(i), corner(i + 1)];
		sum += Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
	}
	return sum / Math.max(Math.floor(corners / 3), 1) || 1;
}
