/** Brush on the fur: the point where the pointer's ray meets the skin, and the ring that shows it. */

import {
	type Camera,
	DataTexture,
	type Intersection,
	LinearFilter,
	Mesh,
	MeshBasicMaterial,
	type Object3D,
	PlaneGeometry,
	Raycaster,
	type Vector2,
	Vector3,
} from 'three';
import type { Fur } from '../../fur/index.ts';
import { PosedSkin } from './PosedSkin.ts';

const outwards = new Vector3(0, 0, 1);

/** Picture of the ring: white with dark rims, to be seen on any fur; soft, without multisampling. */
function ring(size = 128): DataTexture {
	const texels = new Uint8Array(size * size * 4);
	for (let y = 0; y < size; y++) {
		for (let x = 0; x < size; x++) {
			const away = Math.hypot(x + 0.5 - size / 2, y + 0.5 - size / 2) / (size / 2);
			const line = Math.exp(-(((away - 0.92) / 0.022) ** 2));
			const rim = Math.exp(-(((away - 0.92) / 0.05) ** 2));
			const at = 4 * (y * size + x);
			texels.fill(255 * line, at, at + 3);
			texels[at + 3] = 255 * Math.max(line, 0.55 * rim);
		}
	}
	const texture = new DataTexture(texels, size, size);
	texture.magFilter = LinearFilter;
	texture.minFilter = LinearFilter;
	texture.needsUpdate = true;
	return texture;
}

export class Brush extends Mesh<PlaneGeometry, MeshBasicMaterial> {
	/** Place on the skin in its pose, the same on the skin at rest, and the posed skin's normal there; world. */
	readonly place = new Vector3();
	readonly rest = new Vector3();
	readonly normal = new Vector3();
	readonly #caster = new Raycaster();
	readonly #skin = new PosedSkin();
	readonly #hits: Intersection[] = [];

	constructor() {
		const look = { transparent: true, depthTest: false, depthWrite: false, toneMapped: false, opacity: 0.9 };
		super(new PlaneGeometry(2 / 0.92, 2 / 0.92), new MeshBasicMaterial({ map: ring(), ...look }));
		this.name = 'brush';
		// After the fur, which it lies on.
		this.renderOrder = 2;
		this.visible = false;
	}

	/**
	 * Finds where a ray of the picture meets the skin.
	 *
	 * @param pointer in normalised device coordinates
	 * @param body with its skin: a mesh, or a group of some
	 * @returns true for a hit, which sets `place`, `rest` and `normal`
	 */
	aim(pointer: Vector2, camera: Camera, body: { skin: Object3D } & Pick<Fur, 'restPoint'>): boolean {
		this.#hits.length = 0;
		this.#caster.setFromCamera(pointer, camera);
		this.#skin.intersect(this.#caster, body.skin, this.#hits);
		const [hit] = this.#hits;
		if (!hit) return false;
		this.place.copy(hit.point);
		body.restPoint(hit, this.rest);
		this.normal.copy(hit.normal ?? outwards);
		return true;
	}

	/** Puts the ring at its place. @param radius world; @param height above the skin, world */
	lie(radius: number, height: number): void {
		this.position.copy(this.place).addScaledVector(this.normal, height);
		this.quaternion.setFromUnitVectors(outwards, this.normal);
		this.scale.setScalar(radius);
	}
}
