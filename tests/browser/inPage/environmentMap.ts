/** Runs inside the page: a furry ball under `scene.environment` and under three's light probes of the same picture. */

import {
	CubeCamera,
	EquirectangularReflectionMapping,
	FloatType,
	Matrix4,
	type Mesh,
	MeshBasicMaterial,
	PerspectiveCamera,
	PMREMGenerator,
	Scene,
	WebGLCubeRenderTarget,
	WebGLRenderTarget,
} from 'three';
import { LightProbeGenerator } from 'three/addons/lights/LightProbeGenerator.js';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';
import { FurInstances, furMethod, prepareFur } from '../../../web/fur/index.ts';
import { loadFur, renderFloats } from '../../../web/measure/studio.ts';
import { renderer } from './flat.ts';

const SIZE = 96;

/** Decibels of the error of b below the mean square of a. */
const snr = (a: Float32Array, b: Float32Array) => {
	const square = (of: (i: number) => number) => a.reduce((sum, _, i) => sum + of(i) ** 2, 0);
	return 10 * Math.log10(square((i) => a[i] ?? 0) / square((i) => (a[i] ?? 0) - (b[i] ?? Number.NaN)));
};

/** A furry ball alone, with black skin. */
async function stand(url: string) {
	const fur = await loadFur(url);
	const scene = new Scene();
	scene.add(fur.skin.parent ?? fur.skin);
	(fur.skin as Mesh).material = new MeshBasicMaterial({ color: 0 });
	const camera = new PerspectiveCamera(20, 1, 0.1, 100);
	camera.position.set(2, 3, 8);
	camera.lookAt(0, 0, 0);
	const target = new WebGLRenderTarget(SIZE, SIZE, { type: FloatType });
	const drawAtOnce = () => renderFloats(renderer, scene, camera, target).slice();
	const draw = async () => {
		await prepareFur(fur, renderer, scene, camera, target);
		return drawAtOnce();
	};
	return { fur, scene, draw, drawAtOnce };
}

/** Three's own probe of a background. */
async function probeOf(background: Scene) {
	const around = new WebGLCubeRenderTarget(256, { type: FloatType });
	new CubeCamera(0.1, 10, around).update(renderer, background);
	return LightProbeGenerator.fromCubeRenderTarget(renderer, around);
}

/** Decibels of the error of fur under an environment, in each way, below fur under a probe of the same background. */
export interface Found {
	picture: number;
	pmrem: number;
	/** a cube that is drawn anew */
	live: number;
	turned: number;
	/** turned as little as before */
	unturned: number;
	rival: number;
	herd: number;
	/** beside the probe itself */
	beside: number;
	/** brightest pixel without either */
	dark: number;
}

export async function underEnvironment(url: string, file: string): Promise<Found> {
	const { fur, scene, draw, drawAtOnce } = await stand(url);
	const picture = await new EXRLoader().setDataType(FloatType).loadAsync(file);
	picture.mapping = EquirectangularReflectionMapping;
	const place = new Scene();
	place.background = picture;

	const plain = await probeOf(place);
	scene.add(plain);
	const truth = await draw();
	plain.removeFromParent();
	scene.environment = picture;
	const found: Partial<Found> = { picture: snr(truth, await draw()) };
	scene.environment = new PMREMGenerator(renderer).fromEquirectangular(picture).texture;
	found.pmrem = snr(truth, await draw());

	// Without preparation, and drawn anew while it is being read: first a dark place.
	const cube = new WebGLCubeRenderTarget(256, { type: FloatType });
	const eyes = new CubeCamera(0.1, 10, cube);
	eyes.update(renderer, new Scene());
	scene.environment = cube.texture;
	drawAtOnce();
	eyes.update(renderer, place);
	for (let frame = 0; frame < 50 && !(found.live && found.live > 40); frame++) {
		found.live = snr(truth, drawAtOnce());
		await new Promise((resolve) => setTimeout(resolve, 100));
	}

	place.backgroundRotation.set(0.4, 1.9, -0.7);
	place.backgroundIntensity = scene.environmentIntensity = 0.5;
	const turned = await probeOf(place);
	scene.add(turned);
	const turnedTruth = await draw();
	turned.removeFromParent();
	found.unturned = snr(turnedTruth, await draw());
	scene.environmentRotation.copy(place.backgroundRotation);
	found.turned = snr(turnedTruth, await draw());
	scene.add(turned);
	found.beside = snr(turnedTruth, await draw());
	turned.removeFromParent();

	const map = scene.environment;
	/** Decibels of the picture as it is, below the one under the probe. */
	const error = async () => {
		const lit = await draw();
		scene.environment = null;
		scene.add(turned);
		const truth = await draw();
		turned.removeFromParent();
		scene.environment = map;
		return snr(truth, lit);
	};
	const rival = furMethod(fur, 'lengyel', { renderer });
	rival.apply();
	found.rival = await error();
	rival.dispose();
	const herd = new FurInstances(fur, 1);
	herd.setMatrixAt(0, new Matrix4());
	scene.add(herd);
	fur.visible = false;
	await draw(); // a herd learns the picture's height by its first
	found.herd = await error();
	scene.environment = null;
	found.dark = Math.max(...(await draw()).filter((_, i) => i % 4 < 3));
	herd.dispose();
	fur.dispose();
	return found as Found;
}
