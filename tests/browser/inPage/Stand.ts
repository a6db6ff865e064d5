/** What modules with a furry body on its own share: scene, lamp, camera, and pictures as floats. */

import {
	DirectionalLight,
	FloatType,
	HemisphereLight,
	Mesh,
	MeshStandardMaterial,
	type Object3D,
	PerspectiveCamera,
	PlaneGeometry,
	Scene,
	type WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import { renderFloats } from '../../../web/measure/studio.ts';

/** A scene lit from the left and by the sky, seen from the front, over nothing. */
export class Stand {
	readonly scene = new Scene();
	readonly lamp = new DirectionalLight(0xffffff, 6);
	readonly sky = new HemisphereLight(0xffffff, 0x808080, 2);
	readonly camera = new PerspectiveCamera(20, 1, 0.1, 100);
	readonly target: WebGLRenderTarget;
	readonly #renderer: WebGLRenderer;

	/** @param size of its pictures, pixels */
	constructor(renderer: WebGLRenderer, size: number) {
		this.#renderer = renderer;
		this.target = new WebGLRenderTarget(size, size, { type: FloatType });
		this.lamp.position.set(-1, 0.6, 0.6);
		this.scene.add(this.lamp, this.lamp.target, this.sky);
		this.camera.position.set(0, 1, 8);
		this.camera.lookAt(0, 0, 0);
	}

	/** A square that receives shadows. @param y its height */
	addGround(y: number, extent = 20): void {
		const ground = new Mesh(new PlaneGeometry(extent, extent).rotateX(-Math.PI / 2), new MeshStandardMaterial());
		ground.position.y = y;
		ground.receiveShadow = true;
		this.scene.add(ground);
	}

	/** Its picture, rgba, premultiplied, row by row from the bottom. */
	draw(): Float32Array {
		return renderFloats(this.#renderer, this.scene, this.camera, this.target);
	}

	dispose(): void {
		this.lamp.dispose();
		this.target.dispose();
	}
}

/** Peak signal to noise, decibels, of premultiplied pixels in 0..1; 120 for the same. */
export function psnr(a: Float32Array, b: Float32Array): number {
	const sum = a.reduce((total, value, i) => total + (value - (b[i] ?? Number.NaN)) ** 2, 0);
	return -10 * Math.log10(Math.max(sum / a.length, 1e-12));
}

export function toBase64(bytes: Uint8Array): string {
	let text = '';
	for (let i = 0; i < bytes.length; i += 0x8000) text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
	return btoa(text);
}

/** Takes the whiskers off a body: in a herd they are a pixel wide at least. @returns what puts them back */
export function removeWhiskers(root: Object3D): () => void {
	const found: Object3D[] = [];
	root.traverse((part) => part.name.startsWith('whisker') && found.push(part));
	if (found.length === 0) throw new Error('got a body without whiskers, expected some');
	const homes = found.map(({ parent }) => parent);
	for (const part of found) part.removeFromParent();
	return () => {
		for (const [i, part] of found.entries()) homes[i]?.add(part);
	};
}
