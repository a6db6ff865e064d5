import type { Camera, Scene, Texture, WebGLRenderer, WebGLRenderTarget } from 'three';
import type { Fur } from '../Fur.ts';
import { turn } from '../planes/steps.ts';
import { BodyLight } from '../shells/BodyLight.ts';
import { prepareEnvironmentMap } from '../shells/environmentMap.ts';

/**
 * Compiles a fur's programs and uploads its planes in small steps before it is first seen, so that no frame waits for them.
 * Features switched on later (`gloss`, `swing` …) are compiled later.
 *
 * @param scene scene with the lights of the later frames
 * @param target target of the later frames, or one like it; any target for a renderer with an `outputBufferType` and tone mapping,
 * which draws to linear texels first
 */
export async function prepareFur(
	fur: Fur,
	renderer: WebGLRenderer,
	scene: Scene,
	camera: Camera,
	target: WebGLRenderTarget | null = renderer.getRenderTarget(),
): Promise<void> {
	// Without this extension three would warn, and could not tell when programs are ready.
	const aside = renderer.extensions.has('KHR_parallel_shader_compile');
	const before = renderer.getRenderTarget();
	const drawn = [...(fur.fins ? [fur.fins] : []), fur.shells];
	// Materials of fur depend on the lamps' hue, and on the environment.
	for (const part of drawn) part.material.onBeforeRender(renderer, scene, camera);
	for (const part of fur.shells.children) if (part instanceof BodyLight) part.follow();
	renderer.setRenderTarget(target);
	const compiled = drawn.map((part) =>
		aside ? renderer.compileAsync(part, camera, scene) : renderer.compile(part, camera, scene),
	);
	renderer.setRenderTarget(before);
	await Promise.all([...compiled, prepareEnvironmentMap(renderer, scene)]);
	const textures = new Set<Texture>(
		[fur.textures, fur.finTextures].flatMap((those) => Object.values(those ?? {}).filter(Boolean)),
	);
	// Textures that are freed meanwhile stay so.
	const forget = ({ target }: { target: Texture }) => textures.delete(target);
	for (const texture of textures) texture.addEventListener('dispose', forget);
	for (const texture of textures) {
		await turn();
		texture.removeEventListener('dispose', forget);
		if (textures.has(texture)) renderer.initTexture(texture);
	}
}
