/** Runs inside the page: fur in the wind, frame after frame. Its frames go to `steady.spec.ts`. */

import { DirectionalLight, PerspectiveCamera, Scene, WebGLRenderer } from 'three';
import { FurMotion } from '../../../web/fur/index.ts';
import { loadFur } from '../../../web/measure/studio.ts';

/** Frames after which the other springs have their turn. */
const TURN = 150;

/** Draws fur in gusty wind from now on, its springs on the CPU and on the GPU in turn. */
export async function blow(url: string): Promise<void> {
	const renderer = new WebGLRenderer({ antialias: false });
	renderer.setSize(48, 36);
	const fur = await loadFur(url);
	fur.shells.shellCount = 2;
	const scene = new Scene();
	const lamp = new DirectionalLight(0xffffff, 6);
	lamp.position.set(-1, 0.6, 0.6);
	scene.add(lamp, fur.skin.parent ?? fur.skin);
	const camera = new PerspectiveCamera(20, 48 / 36, 0.1, 100);
	camera.position.set(0, 1, 8);
	camera.lookAt(0, 0, 0);
	// One's clock says that the CPU takes too long, and the GPU less.
	let [late, asked] = [0, 0];
	const clock = () => {
		late += 1000 / ++asked;
		return late;
	};
	const motions = [new FurMotion(fur), new FurMotion(fur, { renderer, clock })];
	for (const { wind } of motions) Object.assign(wind, { strength: 0.5, gusts: 0.7 });
	let count = 0;
	const frame = () => {
		requestAnimationFrame(frame);
		fur.motion = motions[Math.floor(count++ / TURN) % 2];
		fur.update(1 / 60);
		renderer.render(scene, camera);
	};
	frame();
}
