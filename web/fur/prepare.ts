import type { Camera, Scene, WebGLRenderer, WebGLRenderTarget } from 'three';
import type { Fur } from './Fur.ts';
import { turn } from './steps.ts';

/**
 * Has a fur's programs compiled and its planes on the GPU before it is first seen, bit by bit, so that no frame waits for it
 * then. What is switched on later (`gloss`, `swing` …) is compiled later.
 *
 * @param scene with the lights that it will be seen under
 * @param target what the scene will be drawn to, or one like it; for a renderer with an `outputBufferType` and tone mapping, which
 * draws to linear texels first, any at all
 */
export async function prepareFur(
	fur: Fur,
	renderer: WebGLRenderer,
	scene: Scene,
	camera: Camera,
	target: WebGLRenderTarget | null = renderer.getRenderTarget(),
): Promise<void> {
	// Without it three would complain, and could not tell when they are ready.
	const aside = renderer.extensions.has('KHR_parallel_shader_compile');
	const before = renderer.getRenderTarget();
	renderer.setRenderTarget(target);
	const compiled = [...(fur.fins ? [fur.fins] : []), fur.shells].map((part) => {
		// Materials of fur go by the lamps' hue.
		part.material.onBeforeRender(renderer, scene, camera);
		return aside ? renderer.compileAsync(part, camera, scene) : renderer.compile(part, camera, scene);
	});
	renderer.setRenderTarget(before);
	await Promise.all(compiled);
	for (const textures of [fur.textures, fur.finTextures]) {
		for (const texture of Object.values(textures ?? {})) {
			await turn();
			if (texture) renderer.initTexture(texture);
		}
	}
}
