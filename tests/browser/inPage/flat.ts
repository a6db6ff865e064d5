/** Runs inside the page: what the stage draws with, and a golden asset laid flat, a pixel a texel. */

import {
	BufferAttribute,
	FloatType,
	NoBlending,
	OrthographicCamera,
	Scene,
	type Texture,
	Vector3,
	WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import type { Fur } from '../../../web/fur/index.ts';
import { renderFloats } from '../../../web/measure/studio.ts';

export const renderer = new WebGLRenderer({ antialias: false });

/** Bytes of level 0 of a texture array as the GPU holds them, layer after layer. */
export function readArray(texture: Texture, size: number, layers: number): Uint8Array {
	renderer.initTexture(texture);
	const gl = renderer.getContext() as WebGL2RenderingContext;
	const handle = (renderer.properties.get(texture) as { __webglTexture: WebGLTexture }).__webglTexture;
	const framebuffer = gl.createFramebuffer();
	gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
	const bytes = new Uint8Array(size * size * layers * 4);
	for (let k = 0; k < layers; k++) {
		gl.framebufferTextureLayer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, handle, 0, k);
		if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE) throw new Error('cannot be read');
		gl.readPixels(0, 0, size, size, gl.RGBA, gl.UNSIGNED_BYTE, bytes.subarray(k * size * size * 4));
	}
	gl.bindFramebuffer(gl.FRAMEBUFFER, null);
	gl.deleteFramebuffer(framebuffer);
	renderer.resetState();
	return bytes;
}

export const channel = (pixels: Float32Array, c: number) =>
	Float32Array.from({ length: pixels.length / 4 }, (_, i) => pixels[i * 4 + c] ?? 0);

/** What the pixels show, without their coverage. */
export function uncovered(pixels: Float32Array): Float32Array {
	const alpha = channel(pixels, 3);
	return channel(pixels, 0).map((red, i) => red / (alpha[i] ?? 0));
}

/** A golden asset laid flat: one pixel per texel, seen from straight above, the light as it is stored. */
export class Flat {
	readonly #scene = new Scene();
	readonly #camera = new OrthographicCamera(-0.5, 0.5, 0.5, -0.5, 0.1, 10);
	readonly #target: WebGLRenderTarget;
	readonly #frame: [Vector3, Vector3, Vector3];

	constructor(readonly fur: Fur) {
		const { shells, asset } = fur;
		const attribute = (name: string) =>
			new Vector3().fromBufferAttribute(shells.geometry.getAttribute(name) as never, 0);
		const n = attribute('normal').normalize();
		const t = attribute('tangent').normalize();
		const b = new Vector3().crossVectors(n, t).multiplyScalar(shells.geometry.getAttribute('tangent').getW(0));
		this.#frame = [t, b, n];
		shells.removeFromParent();
		this.#scene.add(shells);
		this.#scene.updateMatrixWorld();
		shells.geometry.computeBoundingBox();
		const centre = (shells.geometry.boundingBox?.getCenter(new Vector3()) ?? new Vector3()).applyMatrix4(
			shells.matrixWorld,
		);
		this.#camera.up.copy(b);
		this.#camera.position.copy(centre).addScaledVector(n, 5);
		this.#camera.lookAt(centre);
		this.#target = new WebGLRenderTarget(asset.size, asset.size, { type: FloatType });
		shells.material.blending = NoBlending;
		fur.material.contrast = 1;
		shells.automatic = false;
		shells.geometry.instanceCount = 1;
	}

	world([x, y, z]: number[]): Vector3 {
		const [t, b, n] = this.#frame;
		return new Vector3()
			.addScaledVector(t, x ?? 0)
			.addScaledVector(b, y ?? 0)
			.addScaledVector(n, z ?? 0);
	}

	add(...lights: Parameters<Scene['add']>): void {
		this.#scene.add(...lights);
	}

	/** Gives every vertex this value, a comb's along T and B. */
	attribute(name: string, given: number[]): void {
		const value = name === '_comb' ? this.world(given).toArray() : given;
		const { geometry } = this.fur.shells;
		const { count } = geometry.getAttribute('position');
		const values = Float32Array.from({ length: count * value.length }, (_, i) => value[i % value.length] ?? 0);
		geometry.setAttribute(name, new BufferAttribute(values, value.length));
	}

	/** Texels of one shell, [row, column]; of as many as there are layers it is that layer. */
	render(shell: number, count = this.fur.asset.layers): Float32Array {
		const { shells } = this.fur;
		shells.material.shellCount = count;
		(shells.material.uniforms.firstShell as { value: number }).value = shell;
		return renderFloats(renderer, this.#scene, this.#camera, this.#target);
	}

	/** L of one layer's texels, [row, column], under a light like those of the golden lights. */
	light(layer: number): Float32Array {
		return uncovered(this.render(layer));
	}
}
