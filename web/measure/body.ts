/** Pictures of a furry body for comparison with a path tracer: one lamp, black surroundings, linear floats. */

import {
	BufferAttribute,
	DirectionalLight,
	FloatType,
	Mesh,
	MeshBasicMaterial,
	MeshNormalMaterial,
	PerspectiveCamera,
	Scene,
	Sphere,
	Vector3,
	WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import { type Fur, type FurMethodName, fitFurShadow, furMethod } from '../fur/index.ts';
import type { BodyCell, BodyJob } from './bodyJob.ts';
import { loadFur, renderFloats } from './studio.ts';

const BARE = '-bare';

/** Body of a job, drawn in any of its cells. */
export class BodyScene {
	readonly #renderer = new WebGLRenderer({ antialias: false });
	readonly #scene = new Scene();
	readonly #camera: PerspectiveCamera;
	readonly #lamp: DirectionalLight;
	readonly #target: WebGLRenderTarget;
	readonly #centre: Vector3;
	/** Eyes, a nose and the like. */
	readonly #features: Mesh[] = [];
	/** Meshes of the body itself. */
	readonly #skin: Mesh[] = [];
	/** Sums of the passes, by cell. */
	readonly #sums: Float32Array[] = [];

	constructor(
		readonly job: BodyJob,
		readonly fur: Fur,
	) {
		const { width, height, fieldOfView, centre, radius, irradiance, gloss = 0, backlight = 0 } = job;
		this.#renderer.shadowMap.enabled = true;
		this.#centre = new Vector3(...centre);
		this.#camera = new PerspectiveCamera(fieldOfView, width / height, 0.1 * radius, 100 * radius);
		this.#target = new WebGLRenderTarget(width, height, { type: FloatType });
		this.#lamp = new DirectionalLight(0xffffff, irradiance);
		this.#lamp.target.position.copy(this.#centre);
		const body = fur.skin.parent ?? fur.skin;
		body.traverse((piece) => {
			if (!(piece instanceof Mesh) || piece === fur.shells || piece === fur.fins) return;
			let top = piece.parent;
			while (top && top !== fur.skin) top = top.parent;
			(piece === fur.skin || top ? this.#skin : this.#features).push(piece);
		});
		for (const feature of this.#features) feature.visible = false;
		this.#scene.add(body, this.#lamp, this.#lamp.target);
		// Only baked light: no sky, no highlights, no light from behind. The colour of bare skin does not tint the hairs.
		Object.assign(fur.material, { environment: false, gloss, backlight });
		fur.material.skinColor.set(1, 1, 1);
	}

	/** Picture by rows from the bottom: light, premultiplied, one number or three, then coverage. */
	draw(cell: number, method: string): Float32Array {
		const { lamp, eye } = this.job.cells[cell] as BodyCell;
		this.#look(eye);
		const bare = method.endsWith(BARE);
		const light = this.#lamp;
		this.#aim(lamp);
		light.castShadow = !bare;
		const name = (bare ? method.slice(0, -BARE.length) : method) as FurMethodName;
		// Unlit: a hair is as bright as one with L = 1.
		const lighting = furMethod(this.fur, name, {
			renderer: this.#renderer,
			brightness: this.job.irradiance / (4 * Math.PI),
		});
		lighting.apply();
		this.#scene.updateMatrixWorld(true);
		this.fur.update(0);
		const pixels = this.#render();
		lighting.dispose();
		return this.job.coloured ? pixels : pairs(pixels);
	}

	/**
	 * Adds a pass of the samples' own composite to all cells: texels whose red, green and blue are the light of three
	 * directions, on vertices whose colour is the share of each.
	 */
	async addPass(number: number): Promise<void> {
		const name = `/baked/passes/${String(number).padStart(2, '0')}`;
		const [fur, shares] = await Promise.all([loadFur(`${name}/model.gltf`), fetchFloats(`${name}.f32`)]);
		const black = new MeshBasicMaterial({ color: 0 });
		const before = this.#skin.map(({ material }) => material);
		// Add the light of the skin once.
		if (number > 0) for (const piece of this.#skin) piece.material = black;
		Object.assign(fur.material, { tipShare: 0 });
		fur.material.skinColor.set(1, 1, 1);
		const lighting = furMethod(fur, 'unlit', { brightness: 1 });
		lighting.apply();
		this.#show(false);
		this.#scene.add(fur.shells);
		const count = shares.length / this.job.cells.length;
		for (const [i, { eye, lamp }] of this.job.cells.entries()) {
			this.#look(eye);
			this.#aim(lamp);
			const colour = new BufferAttribute(shares.slice(i * count, (i + 1) * count), 3);
			fur.shells.geometry.setAttribute('color', colour);
			this.#scene.updateMatrixWorld(true);
			const pixels = this.#render();
			const sum = this.#sums[i] ?? new Float32Array(pixels.length / 2);
			this.#sums[i] = sum;
			for (let at = 0; at < sum.length; at += 2) {
				const [red, green, blue] = [pixels[2 * at] ?? 0, pixels[2 * at + 1] ?? 0, pixels[2 * at + 2] ?? 0];
				sum[at] = (sum[at] ?? 0) + this.job.brightest * (red + green + blue);
				sum[at + 1] = pixels[2 * at + 3] ?? 0;
			}
		}
		this.#scene.remove(fur.shells);
		lighting.dispose();
		fur.dispose();
		for (const [i, piece] of this.#skin.entries()) piece.material = before[i] as Mesh['material'];
		black.dispose();
		this.#show(true);
	}

	/** Sum of all passes so far, as from `draw`. */
	composite(cell: number): Float32Array {
		return this.#sums[cell] ?? new Float32Array();
	}

	/** Normals by rows from the bottom, four numbers a pixel: the skin's normal, and 1 where it is hit. */
	normals(cell: number): Float32Array {
		const material = new MeshNormalMaterial();
		const pixels = this.#plainly(cell, this.#skin, () => material);
		material.dispose();
		const normal = new Vector3();
		for (let at = 0; at < pixels.length; at += 4) {
			if (!pixels[at + 3]) continue;
			// Stored in the camera's axes, 0..1.
			normal.fromArray(pixels, at).multiplyScalar(2).subScalar(1).transformDirection(this.#camera.matrixWorld);
			normal.toArray(pixels, at);
		}
		return pixels;
	}

	/** Features by rows from the bottom: 1 and 1 where an eye or the like is visible past the skin, else 0. */
	features(cell: number): Float32Array {
		const [hidden, shown] = [new MeshBasicMaterial({ colorWrite: false }), new MeshBasicMaterial()];
		const pixels = this.#plainly(cell, [...this.#skin, ...this.#features], (piece) =>
			this.#features.includes(piece) ? shown : hidden,
		);
		hidden.dispose();
		shown.dispose();
		return pairs(pixels);
	}

	dispose(): void {
		this.fur.dispose();
		this.#target.dispose();
		this.#lamp.dispose();
		this.#renderer.dispose();
	}

	#look(eye: BodyCell['eye']): void {
		this.#camera.position.set(...eye);
		this.#camera.lookAt(this.#centre);
	}

	#aim(lamp: BodyCell['lamp']): void {
		const { radius } = this.job;
		this.#lamp.position
			.set(...lamp)
			.multiplyScalar(4 * radius)
			.add(this.#centre);
		fitFurShadow(this.#lamp, new Sphere(this.#centre, radius + this.fur.asset.length), this.fur.asset.length);
	}

	/** Shows the fur, or the skin alone. */
	#show(on: boolean): void {
		for (const part of [this.fur.shells, this.fur.fins]) if (part) part.visible = on;
	}

	#render(): Float32Array {
		return renderFloats(this.#renderer, this.#scene, this.#camera, this.#target);
	}

	/** Draw some pieces alone, in other materials, without fur. */
	#plainly(cell: number, pieces: readonly Mesh[], dress: (piece: Mesh) => Mesh['material']): Float32Array {
		this.#look((this.job.cells[cell] as BodyCell).eye);
		const before = pieces.map(({ material, visible }) => ({ material, visible }));
		for (const piece of pieces) Object.assign(piece, { material: dress(piece), visible: true });
		this.#show(false);
		const pixels = this.#render();
		this.#show(true);
		for (const [i, piece] of pieces.entries()) Object.assign(piece, before[i]);
		return pixels;
	}
}

/** @param url of an asset's model.gltf */
export async function openBody(url: string, job: BodyJob): Promise<BodyScene> {
	return new BodyScene(job, await loadFur(url));
}

async function fetchFloats(url: string): Promise<Float32Array> {
	return new Float32Array(await (await fetch(url)).arrayBuffer());
}

/** Mean of red, green and blue, and alpha. */
function pairs(rgba: Float32Array): Float32Array {
	const found = new Float32Array(rgba.length / 2);
	for (let i = 0; i < found.length; i += 2) {
		const at = 2 * i;
		found[i] = ((rgba[at] ?? 0) + (rgba[at + 1] ?? 0) + (rgba[at + 2] ?? 0)) / 3;
		found[i + 1] = rgba[at + 3] ?? 0;
	}
	return found;
}

/** Floats as text, for transfer out of the page. */
export async function encoded(floats: Float32Array): Promise<string> {
	const url = await new Promise<string>((resolve, reject) => {
		const reader = new FileReader();
		reader.onload = () => resolve(reader.result as string);
		reader.onerror = () => reject(reader.error);
		reader.readAsDataURL(new Blob([floats as BlobPart]));
	});
	return url.slice(url.indexOf(',') + 1);
}
