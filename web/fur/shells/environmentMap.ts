/** Light of `scene.environment`, which three gives to its own materials alone; the code is fetched with the first such scene. */

import type { Scene, ShaderMaterial, WebGLRenderer } from 'three';
import { fetchParts, parts } from './parts/parts.ts';
import { switchPart } from './switches.ts';

let fetched: Promise<void> | undefined;

function fetchCode(): Promise<void> {
	fetched ??= fetchParts(['environmentMap']);
	return fetched;
}

/** Adapt a material of fur to a scene's environment, dark until it has been read. Call it before each draw. */
export function followEnvironmentMap(material: ShaderMaterial, renderer: WebGLRenderer, scene: Scene): void {
	const { environmentProbe } = material.uniforms;
	const on = scene.environment && environmentProbe && 'SKY' in material.defines;
	switchPart(material, 'ENVIRONMENT_MAP', on ? '' : undefined);
	if (!on) return;
	if (parts.environmentMap) environmentProbe.value = parts.environmentMap.probeOf(renderer, scene);
	else fetchCode();
}

/** Reads a scene's environment, if it has one, so that the next frame has its light. */
export async function prepareEnvironmentMap(renderer: WebGLRenderer, scene: Scene): Promise<void> {
	if (!scene.environment) return;
	await fetchCode();
	await parts.environmentMap?.prepare(renderer, scene);
}
