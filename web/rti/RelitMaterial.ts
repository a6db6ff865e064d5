/** Material of a picture that answers to one lamp. */

import {
	ClampToEdgeWrapping,
	DataArrayTexture,
	DoubleSide,
	LinearFilter,
	LinearMipmapLinearFilter,
	NoColorSpace,
	ShaderMaterial,
	Vector3,
} from 'three';
import { held, type Light, type Plane, type Relit } from './relit.ts';
import fragmentShader from './shaders/relit.frag.glsl?raw';
import vertexShader from './shaders/relit.vert.glsl?raw';
import { UNMAPPED } from './unmapped.ts';

/** Bytes of the texture at the most; larger pictures are drawn smaller. */
const MAX_TEXTURE = 256e6;

export class RelitMaterial extends ShaderMaterial {
	readonly #picture: Relit;
	readonly #weights: Vector3[];
	readonly #offset = new Vector3();

	/** @param largest side of a texture that the GPU takes */
	constructor(picture: Relit, largest: number) {
		const layers = Math.ceil(picture.planes.length / 4);
		const weights = Array.from({ length: 4 * layers }, () => new Vector3());
		super({
			vertexShader,
			fragmentShader: fragmentShader.replace('#include <unmapped>', UNMAPPED),
			side: DoubleSide,
			defines: { LAYERS: layers, ...(picture.colour && { COLOURED: 1 }) },
			uniforms: {
				codes: { value: textureOf(picture, layers, largest) },
				weights: { value: weights },
			},
		});
		this.uniforms.offset = { value: this.#offset };
		this.#picture = picture;
		this.#weights = weights;
		this.light = [0, 0, 1];
	}

	/** Direction to the lamp: right, up, at the eye; of length 1. */
	set light(light: Light) {
		const { scale, bias, planes } = this.#picture;
		const counts = this.#picture.weigh(held(light));
		const offset = this.#offset.fromArray(counts);
		planes.forEach((_, i) => {
			const weight = this.#weights[i] as Vector3;
			weight.fromArray(counts, 3 * i + 3).multiplyScalar(scale[i] as number);
			offset.addScaledVector(weight, -(bias[i] as number));
		});
	}
}

/** Planes in the channels of an array texture, row 0 at the bottom. */
function textureOf({ width, height, planes, colour = [], topDown }: Relit, layers: number, largest: number) {
	const depth = layers + (colour.length ? 1 : 0);
	let step = Math.ceil(Math.max(width, height) / largest);
	const sides = () => [Math.max(Math.floor(width / step), 1), Math.max(Math.floor(height / step), 1)] as const;
	while (sides()[0] * sides()[1] * depth * 4 > MAX_TEXTURE) step++;
	const [across, up] = sides();
	const texels = new Uint8Array(across * up * depth * 4);
	const copy = (plane: Plane, channel: number) => {
		const first = Math.floor(channel / 4) * across * up * 4 + (channel % 4);
		for (let y = 0; y < up; y++)
			for (let x = 0; x < across; x++) texels[first + (y * across + x) * 4] = meanOf(plane, x * step, y * step);
	};
	const meanOf = ({ data, stride, offset }: Plane, x: number, y: number): number => {
		let sum = 0;
		for (let j = y; j < y + step && j < height; j++)
			for (let i = x; i < x + step && i < width; i++)
				sum += data[((topDown ? height - 1 - j : j) * width + i) * stride + offset] as number;
		return sum / (Math.min(step, height - y) * Math.min(step, width - x));
	};
	planes.forEach(copy);
	colour.forEach((plane, i) => {
		copy(plane, 4 * layers + i);
	});
	const texture = new DataArrayTexture(texels, across, up, depth);
	texture.colorSpace = NoColorSpace;
	texture.wrapS = texture.wrapT = ClampToEdgeWrapping;
	texture.magFilter = LinearFilter;
	texture.minFilter = LinearMipmapLinearFilter;
	texture.generateMipmaps = true;
	texture.needsUpdate = true;
	return texture;
}
