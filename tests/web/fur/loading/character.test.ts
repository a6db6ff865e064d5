/** A character of format 2.1 in three's own loader, without the plugin: it moves as the golden sums say. */

import { readFileSync } from 'node:fs';
import { AnimationMixer, Mesh, SkinnedMesh, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { expect, it } from 'vitest';
import { golden, restoreNetwork, serve } from './assets.ts';

restoreNetwork();

const folder = new URL('../../../golden/character/', import.meta.url);
const poses: { clip: number; seconds: number }[] = JSON.parse(readFileSync(new URL('poses.json', folder), 'utf8'));
const posed = new Float32Array(new Uint8Array(readFileSync(new URL('posed.f32', folder))).buffer);
const row = posed.length / poses.length;

it.each(poses.map((pose, i) => [pose.seconds, pose.clip, i]))('at %d s', async (seconds, clip, i) => {
	const { json, files } = golden('character');
	serve(files);
	const { scene, animations } = await new GLTFLoader().parseAsync(JSON.stringify(json), 'http://files.test/');
	const body = scene.getObjectByName('skin');
	if (!(body instanceof SkinnedMesh)) throw new Error(`${body?.type}, expected a skinned mesh`);
	const mixer = new AnimationMixer(scene);
	const action = mixer.clipAction(animations[clip] as (typeof animations)[0]).play();
	action.time = seconds;
	mixer.update(0);
	scene.updateMatrixWorld(true);
	expect(Object.keys(body.morphTargetDictionary ?? {})).toEqual(['bulge', 'twist']);
	const place = new Vector3();
	let off = 0;
	for (let v = 0; v < body.geometry.getAttribute('position').count; v++) {
		Mesh.prototype.getVertexPosition.call(body, v, place);
		body.applyBoneTransform(v, place).applyMatrix4(body.matrixWorld);
		const expected = new Vector3().fromArray(posed, i * row + 3 * v);
		off = Math.max(off, place.distanceTo(expected));
	}
	expect(off).toBeLessThan(1e-5);
});
