/** Light of `scene.environment`, which three gives to its own materials alone; the code is fetched with the first such scene. */

import type { Scene, ShaderMaterial, Texture, WebGLRenderer } from 'three';
import { fetchParts, parts } from './parts/parts.ts';

let fetched: Promise<void> | undefined;

function fetchCode(): Promise<void> {
	fetched ??= fetchParts(['environmentMap']);
	return fetched;
}

/** Adapt a material of fur to a scene's environment, once it has been read. Call it before each draw. */
export function followEnvironment(material: ShaderMaterial, renderer: WebGLRenderer, scene: Scene): void {
	if (parts.environmentMap) parts.environmentMap.follow(material, renderer, scene);
	else if (scene.environment) fetchCode();
}

/** Reads an environment, so that the next frame has its light. */
export async function prepareEnvironment(renderer: WebGLRenderer, environment: Texture): Promise<void> {
	await fetchCode();
	await parts.environmentMap?.prepare(renderer, environment);
}
