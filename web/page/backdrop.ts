/** Surroundings of the model: a soft slate gradient, a contact shadow and a cast shadow. */

import {
	type Box3,
	CircleGeometry,
	Color,
	type ColorRepresentation,
	DataTexture,
	DataUtils,
	HalfFloatType,
	LinearFilter,
	LinearSRGBColorSpace,
	MathUtils,
	Mesh,
	MeshBasicMaterial,
	PlaneGeometry,
	ShadowMaterial,
	SRGBColorSpace,
	UnsignedByteType,
	Vector3,
} from 'three';
import { random } from './random.ts';

const middle: ColorRepresentation = '#56687a';
const rim: ColorRepresentation = '#212a33';

function smoothstep(t: number): number {
	const x = Math.min(Math.max(t, 0), 1);
	return x * x * (3 - 2 * x);
}

/**
 * Radial gradient for `scene.background`, with a grain of one 8-bit step against banding.
 *
 * @param half whether in half floats, which are exact
 */
export function backdrop(half: boolean, size = 384): DataTexture {
	const inner = new Color(middle).convertLinearToSRGB();
	const outer = new Color(rim).convertLinearToSRGB();
	const colour = new Color();
	const texels = new (half ? Uint16Array : Uint8Array)(size * size * 4);
	// Fixed seed: a link shows the same picture to the bit.
	const grain = random(1);
	const stored = half ? DataUtils.toHalfFloat : (value: number) => value * 255 + 0.5;
	for (let y = 0; y < size; y++) {
		for (let x = 0; x < size; x++) {
			const away = Math.hypot((x + 0.5) / size - 0.5, ((y + 0.5) / size - 0.47) * 1.1) / 0.72;
			colour.lerpColors(inner, outer, smoothstep(away));
			colour.addScalar((grain() + grain() - 1) / 255);
			colour.convertSRGBToLinear();
			if (!half) colour.convertLinearToSRGB();
			const at = (y * size + x) * 4;
			texels[at] = stored(colour.r);
			texels[at + 1] = stored(colour.g);
			texels[at + 2] = stored(colour.b);
			texels[at + 3] = stored(1);
		}
	}
	const texture = new DataTexture(texels, size, size);
	texture.type = half ? HalfFloatType : UnsignedByteType;
	texture.colorSpace = half ? LinearSRGBColorSpace : SRGBColorSpace;
	texture.minFilter = LinearFilter;
	texture.magFilter = LinearFilter;
	texture.needsUpdate = true;
	return texture;
}

/** Opacity of the shadow right under a body. */
const darkness = 0.8;

/** Blurred dark disc under the model, seen from above only. */
export class ContactShadow extends Mesh<PlaneGeometry, MeshBasicMaterial> {
	readonly #place = new Vector3();

	constructor(size = 128) {
		const texels = new Uint8Array(size * size * 4);
		for (let y = 0; y < size; y++) {
			for (let x = 0; x < size; x++) {
				const away = Math.hypot(x + 0.5 - size / 2, y + 0.5 - size / 2) / (size / 2);
				texels[(y * size + x) * 4 + 3] = 255 * smoothstep(1 - away) ** 1.6;
			}
		}
		const map = new DataTexture(texels, size, size);
		map.colorSpace = SRGBColorSpace;
		map.magFilter = LinearFilter;
		map.minFilter = LinearFilter;
		map.needsUpdate = true;
		super(
			new PlaneGeometry(1, 1),
			new MeshBasicMaterial({ map, transparent: true, depthWrite: false, opacity: darkness, color: '#141414' }),
		);
		this.rotation.x = -Math.PI / 2;
		// Before the fur, which blends over it.
		this.renderOrder = -1;
	}

	/** Fit the shadow under the box, a little wider. @param fur length of the fur, which reaches beyond the box */
	fit(box: Box3, fur: number): void {
		const size = box.getSize(new Vector3()).addScalar(2 * fur);
		box.getCenter(this.#place).setY(box.min.y - fur / 2);
		this.position.copy(this.#place);
		this.scale.set(size.x * 1.5, size.z * 1.6, 1);
	}

	/**
	 * Follow a moving body on the ground, paler as it rises.
	 *
	 * @param offset of the body from its place at `fit`
	 * @param yaw turn about the upright axis, radians
	 * @param height of the body
	 */
	follow(offset: Vector3, yaw: number, height: number): void {
		this.position.copy(this.#place);
		this.position.x += offset.x;
		this.position.z += offset.z;
		this.rotation.z = yaw;
		this.material.opacity = darkness * Math.exp((-3 * Math.max(offset.y, 0)) / height);
	}
}

/** Opacity of a shadow without any other light. */
const castDarkness = 0.7;

/** Sines of the lamp's elevation between which the shadow fades in. */
const [none, whole] = [0.12, 0.35];

/** Shadow of the body on the ground, from the lamp's shadow map. */
export class CastShadow extends Mesh<CircleGeometry, ShadowMaterial> {
	constructor() {
		super(new CircleGeometry(1, 48), new ShadowMaterial({ color: '#141414', depthWrite: false }));
		this.receiveShadow = true;
		this.rotation.x = -Math.PI / 2;
		// Before the fur, which blends over it, and before the contact shadow on top of it.
		this.renderOrder = -2;
	}

	/** Fit under the box. @param fur length of the fur, which reaches beyond the box */
	fit(box: Box3, fur: number): void {
		this.position.y = box.min.y - fur / 2;
	}

	/**
	 * Move to where the shadow falls.
	 *
	 * @param centre of the body; @param radius of it, world units
	 * @param direction unit vector to the lamp
	 * @param share of the lamp in the light on the ground
	 */
	follow(centre: Vector3, radius: number, direction: Vector3, share: number): void {
		const { y } = direction;
		this.material.opacity = castDarkness * share * MathUtils.smoothstep(y, none, whole);
		if (!(y > none)) return;
		const way = (centre.y - this.position.y) / y;
		this.position.x = centre.x - way * direction.x;
		this.position.z = centre.z - way * direction.z;
		this.scale.setScalar(radius / y);
	}
}
