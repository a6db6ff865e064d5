/** Runs inside the page: furs of one body that take turns or share the picture. Its answers go to `dress.spec.ts`. */

import {
	Color,
	FloatType,
	Mesh,
	type MeshStandardMaterial,
	type Object3D,
	WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import { dressFur, type Fur, FurInstances, furMethod } from '../../../web/fur/index.ts';
import { loadFur, renderFloats } from '../../../web/measure/studio.ts';
import { psnr, removeWhiskers, Stand } from './Stand.ts';

const SIZE = 120;
const renderer = new WebGLRenderer({ antialias: false });
const gl = renderer.getContext() as WebGL2RenderingContext;

/** A furry body alone. */
function standOf(body: Fur): Stand {
	const stand = new Stand(renderer, SIZE);
	stand.scene.add(body.skin.parent ?? body.skin);
	body.shells.shellCount = 8;
	return stand;
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
	const stand = standOf(own);
	const first = stand.draw();
	own.visible = false;
	const bare = stand.draw();
	const alike = dressFur(own, twin);
	alike.shells.shellCount = 8;
	const again = stand.draw();
	const bunny = { tiles: alike.asset.tiles, length: alike.asset.length, expected: own.asset };
	alike.visible = false;
	const fox = dressFur(own, pelt, { tips: 0.5 });
	fox.shells.shellCount = 8;
	const foxy = stand.draw();
	const lengyel = furMethod(fox, 'lengyel');
	lengyel.apply();
	const local = stand.draw();
	lengyel.dispose();
	const putBack = removeWhiskers(own.skin.parent ?? own.skin);
	const shorn = stand.draw();
	const herd = new FurInstances(fox, 1, [8]);
	herd.height = SIZE;
	own.skin.parent?.removeFromParent();
	stand.scene.add(herd);
	const one = stand.draw();
	herd.dispose();
	stand.scene.add(own.skin.parent ?? own.skin);
	putBack();
	fox.visible = false;
	own.visible = true;
	const last = stand.draw();
	const textures = renderer.info.memory.textures;
	fox.dispose();
	alike.dispose();
	// Of its own a dressed body has tables of light alone: mean curves, the slabs of shells and of fins, and lamps at its vertices.
	const tables = 2 * (3 + 3);
	const kept = renderer.info.memory.textures === textures - tables && apart(stand.draw(), first) === 0;
	for (const fur of [pelt, own, twin]) fur.dispose();
	stand.dispose();
	return {
		alike: psnr(again, first),
		bunny,
		bareIsSmaller: outline(bare) < 0.9 * outline(first),
		other: psnr(foxy, first),
		method: psnr(local, foxy),
		herd: psnr(one, shorn),
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
	const stand = standOf(white);
	const dark = dressFur(white, white);
	dark.shells.shellCount = 8;
	for (const name of ['root', 'tip', 'tip2'] as const) white.material[name] = new Color(1, 1, 1);
	const shown = (...furs: Fur[]) => {
		for (const fur of [white, dark]) fur.visible = furs.includes(fur);
		return stand.draw();
	};
	const [left, right, bare] = [shown(white), shown(dark), shown()];
	white.clip = { from: 0, to: at };
	dark.clip = { from: at, to: 1 };
	const both = shown(white, dark);
	// In half of the canvas only, by the renderer's own scissor.
	const half = new WebGLRenderTarget(SIZE, SIZE, { type: FloatType });
	half.scissor.set(0, 0, SIZE, SIZE / 2);
	half.scissorTest = true;
	const part = renderFloats(renderer, stand.scene, stand.camera, half);
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
	stand.dispose();
	const { geometries, textures } = renderer.info.memory;
	return { left: { geometries, textures }, early, roots, differences, error: gl.getError() };
}

/** How much of the picture fur covers, by density and by length, and by methods that were made before and after. */
export async function cover(url: string) {
	const fur = await loadFur(url);
	const stand = standOf(fur);
	fur.skin.visible = false;
	const { material } = fur;
	const dense = (density: number) => {
		material.density = density;
		return stand.draw();
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
		return stand.draw();
	});
	material.density = 1;
	const thin = stand.draw();
	const maps = furMethod(fur, 'shadow-layers', { renderer });
	maps.apply();
	fur.update(0);
	const shaded = stand.draw();
	fur.shells.material.density = 2;
	const drawn = fur.update(0);
	const shadedMore = stand.draw();
	for (const method of [before, after, maps]) method.dispose();
	const densityByRival = material.density;
	material.density = 1;

	fur.shells.automatic = true;
	const lengths = [0.5, 1, 1.5].map((length) => {
		fur.length = length * fur.asset.length;
		const pixels = stand.draw();
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
	stand.scene.add(herd);
	const herds = [1, 0.5].map((length) => {
		fur.length = length * fur.asset.length;
		return outline(stand.draw());
	});
	// What is left of cut fur is its densest part.
	fur.length = fur.asset.length;
	const whole = stand.draw();
	fur.clip = { from: 0, to: 0.5 };
	const half = stand.draw();
	fur.clip = undefined;
	material.density = 3;
	const crowd = {
		denser: covered(stand.draw()) / covered(whole),
		left: apart(half, whole, 0, SIZE / 2),
		right: apart(half, whole, SIZE / 2),
	};
	herd.dispose();
	fur.dispose();
	stand.dispose();
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
