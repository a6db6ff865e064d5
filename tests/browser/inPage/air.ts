/** Runs inside the page: fur in fog, by logarithmic depth, and multisampled. Its answers go to `air.spec.ts`. */

import { DataUtils, Fog, FogExp2, HalfFloatType, WebGLRenderer, WebGLRenderTarget } from 'three';
import { type FurMethodName, furMethod } from '../../../web/fur/index.ts';
import { loadFur } from '../../../web/measure/studio.ts';
import { psnr, Stand } from './Stand.ts';

const SIZE = 96;

/** The ball's pictures, one after each setting. */
async function pictures(
	renderer: WebGLRenderer,
	url: string,
	settings: readonly ((stand: Stand) => void)[],
	method?: FurMethodName,
): Promise<Float32Array[]> {
	const fur = await loadFur(url);
	const stand = new Stand(renderer, SIZE);
	stand.scene.add(fur.skin.parent ?? fur.skin);
	if (method) furMethod(fur, method).apply();
	const found = settings.map((set) => {
		set(stand);
		return stand.draw();
	});
	fur.dispose();
	stand.dispose();
	renderer.dispose();
	return found;
}

/**
 * Colours of the pixels that the ball hides, in fog of this colour: near enough that all is fog, so far that nothing is, and
 * as dense as to hide half of what stands in the middle of the ball. Without fog, then in each.
 */
export async function foggy(url: string, colour: number, method?: FurMethodName): Promise<number[][]> {
	const all = await pictures(
		new WebGLRenderer(),
		url,
		[
			() => {},
			({ scene }) => (scene.fog = new Fog(colour, 0.1, 0.2)),
			({ scene }) => (scene.fog = new Fog(colour, 50, 90)),
			({ scene, camera }) => (scene.fog = new FogExp2(colour, Math.sqrt(Math.LN2) / camera.position.length())),
		],
		method,
	);
	return all.map((pixels) => {
		const sums = [0, 0, 0, 0];
		for (let i = 0; i < pixels.length; i += 4)
			if ((pixels[i + 3] ?? 0) > 0.999) for (let c = 0; c < 4; c++) sums[c] = (sums[c] ?? 0) + (pixels[i + c] ?? 0);
		return sums.map((sum) => sum / (sums[3] ?? 0));
	});
}

/** Least radiance of the pixels of a body seen from around it, four samples each. */
export async function least(url: string): Promise<number> {
	const renderer = new WebGLRenderer();
	const fur = await loadFur(url);
	const stand = new Stand(renderer, 1);
	const { scene, camera, lamp, sky } = stand;
	scene.add(fur.skin.parent ?? fur.skin);
	scene.remove(sky);
	Object.assign(camera, { fov: 30, aspect: 4 / 3 }).updateProjectionMatrix();
	const target = new WebGLRenderTarget(320, 240, { type: HalfFloatType, samples: 4 });
	const pixels = new Uint16Array(320 * 240 * 4);
	renderer.setRenderTarget(target);
	let found = Number.POSITIVE_INFINITY;
	for (const turn of [-0.2, 0, 0.7, 0.9]) {
		camera.position.set(5 * Math.sin(turn), 2, 5 * Math.cos(turn)).setLength(5);
		camera.lookAt(0, 0, 0);
		lamp.position.set(-0.82, 0.57, -0.02).applyAxisAngle(camera.up, turn);
		renderer.render(scene, camera);
		renderer.readRenderTargetPixels(target, 0, 0, 320, 240, pixels);
		for (const half of pixels) found = Math.min(found, DataUtils.fromHalfFloat(half));
	}
	target.dispose();
	fur.dispose();
	stand.dispose();
	renderer.dispose();
	return found;
}

/** Decibels between the ball's pictures with depths as usual and with their logarithms. */
export async function logarithmic(url: string): Promise<number> {
	const draw = async (logarithmicDepthBuffer: boolean) =>
		(await pictures(new WebGLRenderer({ logarithmicDepthBuffer }), url, [() => {}]))[0] as Float32Array;
	return psnr(await draw(false), await draw(true));
}
