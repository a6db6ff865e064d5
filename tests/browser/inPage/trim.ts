/** Runs inside the page: fur of several lengths. Its answers go to `trim.spec.ts`. */

import {
	CustomBlending,
	DirectionalLight,
	FloatType,
	HemisphereLight,
	type Mesh,
	MeshBasicMaterial,
	PerspectiveCamera,
	Scene,
	WebGLRenderTarget,
} from 'three';
import { furMethod } from '../../../web/fur/index.ts';
import { loadFur, renderFloats } from '../../../web/measure/studio.ts';
import { channel, Flat, renderer } from './flat.ts';

const SIZE = 120;
const gl = renderer.getContext() as WebGL2RenderingContext;

const sum = (values: Float32Array) => values.reduce((total, value) => total + value, 0);

/** A body by lengths: pixels that it covers, its shells, how high its fins reach, and what a rival makes of it. */
export async function shorn(url: string, lengths: readonly number[]) {
	const fur = await loadFur(url);
	const scene = new Scene();
	const lamp = new DirectionalLight(0xffffff, 6);
	lamp.position.set(-1, 0.6, 0.6);
	scene.add(lamp, new HemisphereLight(0xffffff, 0x808080, 2), fur.skin.parent ?? fur.skin);
	const camera = new PerspectiveCamera(20, 1, 0.1, 100);
	camera.position.set(0, 1, 5);
	camera.lookAt(0, 0, 0);
	const target = new WebGLRenderTarget(SIZE, SIZE, { type: FloatType });
	const draw = () => renderFloats(renderer, scene, camera, target);
	const before = draw();
	const hidden = new MeshBasicMaterial({ colorWrite: false });
	const skin = fur.skin as Mesh;
	const shade = skin.material;
	const each = lengths.map((length) => {
		fur.length = length * fur.asset.length;
		skin.material = hidden;
		const whole = draw();
		const { shells, fins } = fur;
		shells.visible = false;
		const finPixels = channel(draw(), 3).filter((value) => value > 0.05).length;
		shells.visible = true;
		const method = furMethod(fur, 'lengyel');
		method.apply();
		const rival = channel(draw(), 3);
		method.dispose();
		skin.material = shade;
		const alpha = channel(whole, 3);
		return {
			outline: alpha.filter((value) => value > 0.05).length,
			light: sum(channel(whole, 0)) / sum(alpha),
			shells: shells.shellCount,
			radius: shells.geometry.boundingSphere?.radius ?? 0,
			finPixels,
			finRadius: fins?.geometry.boundingSphere?.radius ?? 0,
			// Fins are in both, as they are.
			rival: alpha.reduce((worst, value, i) => Math.max(worst, Math.abs(value - (rival[i] ?? 0))), 0),
		};
	});
	fur.length = fur.asset.length;
	const after = draw();
	fur.dispose();
	target.dispose();
	hidden.dispose();
	return {
		each,
		same: after.every((value, i) => Object.is(value, before[i])),
		error: gl.getError(),
	};
}

/** A tile of fur from straight above, by lengths: its coverage and its brightness, and how much it minds which side light is on. */
export async function stubble(url: string, lengths: readonly number[]) {
	const flat = new Flat(await loadFur(url));
	const { fur } = flat;
	const lamp = new DirectionalLight(0xffffff, 4 * Math.PI);
	flat.add(lamp, lamp.target);
	fur.shells.material.blending = CustomBlending;
	const count = 2 * fur.asset.layers;
	const from = (light: number[]) => {
		lamp.position.copy(flat.world(light)).multiplyScalar(10);
		fur.shells.geometry.instanceCount = count;
		return flat.render(0, count);
	};
	const each = lengths.map((length) => {
		fur.length = length * fur.asset.length;
		const [left, right, above] = [from([-0.8, 0, 0.6]), from([0.8, 0, 0.6]), from([0, 0, 1])];
		const [a, b] = [channel(left, 0), channel(right, 0)];
		return {
			covered: sum(channel(above, 3)) / (above.length / 4),
			brightness: sum(channel(above, 0)) / sum(channel(above, 3)),
			sidedness: a.reduce((total, value, i) => total + Math.abs(value - (b[i] ?? 0)), 0) / (sum(a) + sum(b)),
		};
	});
	fur.dispose();
	return { each, error: gl.getError() };
}
