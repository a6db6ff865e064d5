/** Ground that a model stands on: a matt disc that the lamp lights and shades, and the soft dark right under a body. */

import {
	type Box3,
	Color,
	DataTexture,
	Float32BufferAttribute,
	LinearFilter,
	MathUtils,
	Mesh,
	MeshBasicMaterial,
	MeshLambertMaterial,
	PlaneGeometry,
	RingGeometry,
	SRGBColorSpace,
	Vector3,
} from 'three';

/** Albedo of the pages' own ground, linear: as dark as the backdrop where the key light falls on it. */
export const SLATE: Readonly<Color> = new Color(0.026, 0.037, 0.05);

/** Distances from the middle, over the radius, between which the ground fades into the backdrop. */
const [WHOLE, NONE] = [0.12, 1];

/** Matt disc of radius 1 that fades into the backdrop, lit by the scene and under its shadows; seen from above only. */
export class Ground extends Mesh<RingGeometry, MeshLambertMaterial> {
	constructor() {
		const geometry = new RingGeometry(0, 1, 64, 16).rotateX(-Math.PI / 2);
		const position = geometry.getAttribute('position');
		const shades = Array.from({ length: position.count }, (_, i) => {
			const away = Math.hypot(position.getX(i), position.getZ(i));
			return [1, 1, 1, (1 - MathUtils.smoothstep(away, WHOLE, NONE)) ** 1.5];
		});
		geometry.setAttribute('color', new Float32BufferAttribute(shades.flat(), 4));
		super(geometry, new MeshLambertMaterial({ vertexColors: true, transparent: true, depthWrite: false }));
		this.material.color.copy(SLATE);
		this.receiveShadow = true;
		// Before the contact shadow, which lies on it, and before the fur, which blends over both.
		this.renderOrder = -2;
	}

	/** Lie under the box. @param height of the ground; @param radius world units */
	fit(box: Box3, height: number, radius: number): void {
		box.getCenter(this.position).setY(height - 1e-4 * radius);
		this.scale.setScalar(radius);
	}
}

const middle = new Vector3();

/** Opacity of the shadow right under a body. */
const darkness = 0.8;

/** Blurred dark disc under the model, seen from above only: light of the sky that the body keeps off. */
export class ContactShadow extends Mesh<PlaneGeometry, MeshBasicMaterial> {
	readonly #place = new Vector3();

	constructor(size = 128) {
		const texels = new Uint8Array(size * size * 4);
		for (let y = 0; y < size; y++) {
			for (let x = 0; x < size; x++) {
				const away = Math.hypot(x + 0.5 - size / 2, y + 0.5 - size / 2) / (size / 2);
				texels[(y * size + x) * 4 + 3] = 255 * MathUtils.smoothstep(1 - away, 0, 1) ** 1.6;
			}
		}
		const map = new DataTexture(texels, size, size);
		map.colorSpace = SRGBColorSpace;
		map.magFilter = LinearFilter;
		map.minFilter = LinearFilter;
		map.needsUpdate = true;
		super(
			new PlaneGeometry(1, 1),
			new MeshBasicMaterial({ map, transparent: true, depthWrite: false, opacity: darkness, color: '#000000' }),
		);
		this.rotation.x = -Math.PI / 2;
		// Before the fur, which blends over it.
		this.renderOrder = -1;
	}

	/**
	 * Fit the shadow under the box, a little wider.
	 *
	 * @param fur length of the fur, which reaches beyond the box; @param height of the ground
	 */
	fit(box: Box3, fur: number, height: number): void {
		const size = box.getSize(middle).addScalar(2 * fur);
		box.getCenter(this.#place).setY(height);
		this.position.copy(this.#place);
		this.scale.set(size.x * 1.5, size.z * 1.6, 1);
	}

	/**
	 * Follow a moving body on the ground, paler as it rises.
	 *
	 * @param offset of the body from its place at `fit`
	 * @param yaw turn about the upright axis, radians
	 * @param height of the body
	 * @param body it turns about the middle of this box; without it about the shadow's own
	 */
	follow(offset: Vector3, yaw: number, height: number, body?: Box3): void {
		this.position.copy(this.#place);
		if (body) {
			body.getCenter(middle).setY(this.#place.y);
			this.position.sub(middle).applyAxisAngle(this.up, yaw).add(middle);
		}
		this.position.x += offset.x;
		this.position.z += offset.z;
		this.rotation.z = yaw;
		this.material.opacity = darkness * Math.exp((-3 * Math.max(offset.y, 0)) / height);
	}
}
