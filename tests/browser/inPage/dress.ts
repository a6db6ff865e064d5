/** Runs inside the page: furs of one body that take turns or share the picture. Its answers go to `dress.spec.ts`. */

import {
	Color,
	DirectionalLight,
	FloatType,
	HemisphereLight,
	Mesh,
	type MeshStandardMaterial,
	type Object3D,
	PerspectiveCamera,
	Scene,
	WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import { dressFur, type Fur, FurInstances, furMethod } from '../../../web/fur/index.ts';
import { loadFur, renderFloats } from '../../../web/measure/studio.ts';

const SIZE = 120;
const renderer = new WebGLRenderer({ antialias: false });
const gl = renderer.getContext() as WebGL2RenderingContext;

/** A furry body alone, lit from the left and by the sky. */
class Scenery {
	readonly scene = new Scene();
	readonly lamp = new DirectionalLight(0xffffff, 6);
	readonly camera = new PerspectiveCamera(20, 1, 0.1, 100);
	readonly #target = new WebGLRenderTarget(SIZE, SIZE, { type: FloatType });

	constructor(readonly body: Fur) {
		this.lamp.position.set(-1, 0.6, 0.6);
		this.scene.add(this.lamp, this.lamp.target, new HemisphereLight(0xffffff, 0x808080, 2));
		this.scene.add(body.skin.parent ?? body.skin);
		this.camera.position.set(0, 1, 8);
		this.camera.lookAt(0, 0, 0);
		body.shells.shellCount = 8;
	}

	draw(): Float32Array {
		return renderFloats(renderer, this.scene, this.camera, this.#target);
	}

	dispose(): void {
		this.#target.dispose();
	}
}

/** Peak signal to noise, decibels, of premultiplied pixels in 0..1. */
function psnr(a: Float32Array, b: Float32Array): number {
	const sum = a.reduce((total, value, i) => total + (value - (b[i] ?? Number.NaN)) ** 2, 0);
	return -10 * Math.log10(sum / a.length);
}

/** Largest difference in some columns of the picture, [first, last). */
function apart(a: Float32Array, b: Float32Array, first = 0, last = SIZE): number {
	let worst = 0;
	a.forEach((value, i) => {
		const column = (i >> 2) % SIZE;
		if (column >= first && column < last) worst = Math.max(worst, Math.abs(value - (b[i] ?? Number.NaN)));
	});
	return worst;
}

/** Sum of coverage, pixels. */
const covered = (pixels: Float32Array) => pixels.reduce((sum, value, i) => sum + (i % 4 === 3 ? value : 0), 0);

/** Pixels in which there is anything. */
const outline = (pixels: Float32Array) => pixels.filter((value, i) => i % 4 === 3 && value > 0.05).length;

/** A body in a pelt of its own and in another one, and undressed again. */
export async function wardrobe(body: string, same: string, other: string) {
	const [own, twin, pelt] = await Promise.all([body, same, other].map((url) => loadFur(url)));
	if (!own || !twin || !pelt) throw new Error('nothing to wear');
	const stage = new Scenery(own);
	const first = stage.draw();
	own.visible = false;
	const bare = stage.draw();
	const alike = dressFur(own, twin);
	alike.shells.shellCount = 8;
	const again = stage.draw();
	const bunny = { tiles: alike.asset.tiles, length: alike.asset.length, expected: own.asset };
	alike.visible = false;
	const fox = dressFur(own, pelt, { tips: 0.5 });
	fox.shells.shellCount = 8;
	const foxy = stage.draw();
	const lengyel = furMethod(fox, 'lengyel');
	lengyel.apply();
	const local = stage.draw();
	lengyel.dispose();
	const herd = new FurInstances(fox, 1, [8]);
	herd.height = SIZE;
	own.skin.parent?.removeFromParent();
	stage.scene.add(herd);
	const one = stage.draw();
	herd.dispose();
	stage.scene.add(own.skin.parent ?? own.skin);
	fox.visible = false;
	own.visible = true;
	const last = stage.draw();
	const textures = renderer.info.memory.textures;
	fox.dispose();
	alike.dispose();
	// Of its own a dressed body has tables of light alone: mean curves, the slabs of shells and of fins, and lamps at its vertices.
	const tables = 2 * (3 + 3);
	const kept = renderer.info.memory.textures === textures - tables && apart(stage.draw(), first) === 0;
	for (const fur of [pelt, own, twin]) fur.dispose();
	stage.dispose();
	return {
		alike: psnr(again, first),
		bunny,
		bareIsSmaller: outline(bare) < 0.9 * outline(first),
		other: psnr(foxy, first),
		method: psnr(local, foxy),
		herd: psnr(one, foxy),
		last: apart(last, first),
		kept,
		error: gl.getError(),
	};
}

/** One body whose two furs, white and dark, meet at a column. */
export async function split(url: string, at: number) {
	// What is there when the skin can be shown: no fur, and the body as dark as below it.
	const early: string[] = [];
	const skin = (scene: Object3D) => {
		scene.traverse((part) => {
			if (part instanceof Mesh) early.push(part.name);
		});
	};
	const white = await loadFur(url, { skin });
	const roots = (white.skin as Mesh<never, MeshStandardMaterial>).material.color.r / white.asset.ramp.root[0];
	const stage = new Scenery(white);
	const dark = dressFur(white, white);
	dark.shells.shellCount = 8;
	for (const name of ['root', 'tip', 'tip2'] as const) white.material[name] = new Color(1, 1, 1);
	const shown = (...furs: Fur[]) => {
		for (const fur of [white, dark]) fur.visible = furs.includes(fur);
		return stage.draw();
	};
	const [left, right, bare] = [shown(white), shown(dark), shown()];
	white.clip = { from: 0, to: at };
	dark.clip = { from: at, to: 1 };
	const both = shown(white, dark);
	// In half of the canvas only, by the renderer's own scissor.
	const half = new WebGLRenderTarget(SIZE, SIZE, { type: FloatType });
	half.scissor.set(0, 0, SIZE, SIZE / 2);
	half.scissorTest = true;
	const part = renderFloats(renderer, stage.scene, stage.camera, half);
	const rows = (pixels: Float32Array, first: number, last: number) =>
		pixels.subarray(first * SIZE * 4, last * SIZE * 4);
	white.clip = dark.clip = undefined;
	const whole = shown(dark);
	const column = Math.round(at * SIZE);
	const differences = {
		left: apart(both, left, 0, column),
		right: apart(both, right, column),
		swapped: apart(left, right),
		bare: apart(left, bare),
		whole: apart(whole, right),
		lower: apart(rows(part, 0, SIZE / 2), rows(both, 0, SIZE / 2)),
		upper: Math.max(...rows(part, SIZE / 2, SIZE)),
	};
	// The body before what it wears: whatever the order, nothing is left.
	white.dispose();
	dark.dispose();
	half.dispose();
	stage.dispose();
	const { geometries, textures } = renderer.info.memory;
	return { left: { geometries, textures }, early, roots, differences, error: gl.getError() };
}

/** How much of the picture fur covers, by density and by length, and by methods that were made before and after. */
export async function cover(url: string) {
	const fur = await loadFur(url);
	const stage = new Scenery(fur);
	fur.skin.visible = false;
	const { material } = fur;
	const dense = (density: number) => {
		material.density = density;
		return stage.draw();
	};
	const densities = [0.4, 1, 2].map((density) => covered(dense(density)));
	const light = [1, 2].map((density) => {
		const pixels = dense(density);
		return pixels.reduce((sum, value, i) => sum + (i % 4 === 3 ? 0 : value), 0) / (3 * covered(pixels));
	});
	const before = furMethod(fur, 'lengyel');
	material.density = 2;
	const after = furMethod(fur, 'lengyel');
	const methods = [before, after].map((method) => {
		method.apply();
		return stage.draw();
	});
	material.density = 1;
	const thin = stage.draw();
	const maps = furMethod(fur, 'shadow-layers', { renderer });
	maps.apply();
	fur.update(0);
	const shaded = stage.draw();
	fur.shells.material.density = 2;
	const drawn = fur.update(0);
	const shadedMore = stage.draw();
	for (const method of [before, after, maps]) method.dispose();
	const densityByRival = material.density;
	material.density = 1;

	fur.shells.automatic = true;
	const lengths = [0.5, 1, 1.5].map((length) => {
		fur.length = length * fur.asset.length;
		const pixels = stage.draw();
		return {
			outline: outline(pixels),
			shells: fur.shells.shellCount,
			radius: fur.shells.geometry.boundingSphere?.radius ?? 0,
			fins: fur.fins?.geometry.boundingSphere?.radius ?? 0,
		};
	});
	fur.shells.shellCount = 8;
	fur.length = fur.asset.length;
	const root = fur.skin.parent ?? fur.skin;
	const herd = new FurInstances(fur, 1, [8]);
	herd.height = SIZE;
	root.removeFromParent();
	stage.scene.add(herd);
	const herds = [1, 0.5].map((length) => {
		fur.length = length * fur.asset.length;
		return outline(stage.draw());
	});
	// What is left of cut fur is its densest part.
	fur.length = fur.asset.length;
	const whole = stage.draw();
	fur.clip = { from: 0, to: 0.5 };
	const half = stage.draw();
	fur.clip = undefined;
	material.density = 3;
	const crowd = {
		denser: covered(stage.draw()) / covered(whole),
		left: apart(half, whole, 0, SIZE / 2),
		right: apart(half, whole, SIZE / 2),
	};
	herd.dispose();
	fur.dispose();
	stage.dispose();
	return {
		crowd,
		densities,
		light,
		rivals: {
			same: apart(...(methods as [Float32Array, Float32Array])),
			thinner: covered(thin) / covered(methods[0] as Float32Array),
		},
		maps: { drawn, denser: covered(shadedMore) / covered(shaded), densityByRival },
		lengths,
		herds,
		error: gl.getError(),
	};
}
