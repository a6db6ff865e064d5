import type { BufferGeometry, Mesh } from 'three';
import type { Roots } from './roots/Roots.ts';
import { unshareGeometry } from './shareGeometry.ts';
import type { Skin } from './skin/Skin.ts';

/** A fur, as far as it can be shared. */
interface SharedFur {
	readonly shells: Mesh;
	readonly fins: Mesh | undefined;
	readonly ground: { readonly skin: Skin; readonly roots?: Roots | undefined };
	readonly pelt: { dispose(): void };
}

const geometriesOf = ({ shells, fins }: SharedFur): BufferGeometry[] => [
	shells.geometry,
	...(fins ? [fins.geometry] : []),
];

/** Part of a fur that is its own, not borrowed: the whole body with its pelt, the vertices below shells and fins alone, or nothing. */
export type Owned = 'body' | 'vertices' | 'nothing';

/** A fur and those of its body's copies, which share vertices and textures: freed with the last of them. */
export class Sharers {
	readonly #furs = new Set<SharedFur>();
	readonly #owned: Owned;

	constructor(owned: Owned) {
		this.#owned = owned;
	}

	add(fur: SharedFur): void {
		this.#furs.add(fur);
	}

	/** Takes a fur out and frees its body and pelt as far as no other fur has them; geometries are left to be disposed of. */
	leave(fur: SharedFur): void {
		this.#furs.delete(fur);
		const others = [...this.#furs];
		const { skin } = fur.ground;
		const last = others.length === 0;
		if (last && this.#owned !== 'nothing')
			for (const geometry of geometriesOf(fur)) skin.pose?.morphsOf(geometry)?.texture.dispose();
		const keepers = this.#owned === 'nothing' ? undefined : others.flatMap(geometriesOf);
		for (const geometry of geometriesOf(fur)) unshareGeometry(geometry, keepers);
		if (this.#owned !== 'body') return;
		if (last) {
			fur.pelt.dispose();
			fur.ground.roots?.texture.dispose();
		}
		skin.pose?.skeleton?.dispose();
		skin.dispose(others.flatMap(({ ground }) => ground.skin.geometries));
	}
}
