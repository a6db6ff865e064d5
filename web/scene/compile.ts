/** Programs of a scene and its furs, compiled while the page goes on. */

import { type Camera, DataTexture, type Object3D, type Scene, type WebGLRenderer, type WebGLRenderTarget } from 'three';
import { type Fur, prepareFur } from '../fur/index.ts';

/** True where the browser compiles programs while the page goes on. */
export const compilesAside = (renderer: WebGLRenderer): boolean =>
	renderer.extensions.has('KHR_parallel_shader_compile');

/**
 * Compiles all programs at a time before the first picture that needs them; graphics cards take seconds for them, one after
 * the other, and the page would stand still meanwhile. Where the browser cannot do so at the side nothing is done: the first
 * picture spares what it does not show.
 *
 * @param target target of the picture
 * @param furs on show
 */
export async function compileScene(
	renderer: WebGLRenderer,
	scene: Scene,
	camera: Camera,
	target: WebGLRenderTarget,
	furs: readonly Fur[] = [],
): Promise<void> {
	if (!compilesAside(renderer)) return;
	const programs: Promise<unknown>[] = furs.map((fur) => prepareFur(fur, renderer, scene, camera, target));
	const before = renderer.getRenderTarget();
	renderer.setRenderTarget(target);
	// Three compiles what is hidden, too, as the body's own fur is below another one; the lamps are those of the scene.
	const seen = { traverse: scene.traverseVisible.bind(scene), traverseVisible() {} };
	programs.push(renderer.compileAsync(seen as unknown as Object3D, camera, scene));
	renderer.setRenderTarget(before);
	await Promise.all(programs);
}

const motionless = new DataTexture();

/** Compiles what furs at rest need once they swing, and those that swing once they rest, without being waited for. */
export function compileMotion(
	renderer: WebGLRenderer,
	scene: Scene,
	camera: Camera,
	target: WebGLRenderTarget,
	furs: readonly Fur[],
): void {
	if (!compilesAside(renderer)) return;
	for (const fur of furs) {
		const { swing } = fur;
		fur.swing = swing ? undefined : motionless;
		void prepareFur(fur, renderer, scene, camera, target);
		fur.swing = swing;
	}
}
