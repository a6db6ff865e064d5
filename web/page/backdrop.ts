/** Backdrop of the model: a soft slate gradient. */

import {
	Color,
	type ColorRepresentation,
	DataTexture,
	DataUtils,
	HalfFloatType,
	LinearFilter,
	LinearSRGBColorSpace,
	MathUtils,
	SRGBColorSpace,
	UnsignedByteType,
} from 'three';
import { random } from './random.ts';

const middle: ColorRepresentation = '#56687a';
const rim: ColorRepresentation = '#212a33';

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
			colour.lerpColors(inner, outer, MathUtils.smoothstep(away, 0, 1));
			colour.addScalar((grain() + grain() - 1) / 255);
			if (half) colour.convertSRGBToLinear();
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
