/** Runs inside the page: a whisker ever farther away. Its columns go to `thin.spec.ts`. */

import {
	DirectionalLight,
	FloatType,
	Mesh,
	MeshStandardMaterial,
	PerspectiveCamera,
	Scene,
	SphereGeometry,
	Vector3,
	WebGLRenderTarget,
} from 'three';
import { keepThinFurParts } from '../../../web/fur/index.ts';
import { renderFloats } from '../../../web/measure/studio.ts';
import { renderer } from './flat.ts';

const WIDTH = 128;
const HEIGHT = 96;
const target = new WebGLRenderTarget(WIDTH, HEIGHT, { type: FloatType });

/**
 * Draws a whisker of length 2 and of unit width 2·radius over a sphere that it stands on.
 *
 * @param radius of the whisker, pixels; @param turn of it from the horizontal, degrees
 * @returns lit pixels in each column of the picture that the sphere is not in
 */
export function whisker(kept: boolean, radius: number, turn: number): number[] {
	const scene = new Scene();
	const camera = new PerspectiveCamera(30, WIDTH / HEIGHT, 1, 40);
	camera.position.z = 10;
	const pixel = (2 * 10 * Math.tan(Math.PI / 12)) / HEIGHT;
	const white = new MeshStandardMaterial({ color: 0xffffff });
	const body = new Mesh(new SphereGeometry(0.5, 16, 12), white);
	const part = new Mesh(new SphereGeometry(1, 8, 16), white);
	part.scale.set(radius * pixel, 1, radius * pixel);
	part.rotation.z = Math.PI / 2 + (turn * Math.PI) / 180;
	part.position.set(0, 0.013, 0).add(new Vector3(0, 1, 0).applyEuler(part.rotation).multiplyScalar(-1.2));
	const lamp = new DirectionalLight(0xffffff, 6);
	lamp.position.z = 1;
	scene.add(body.add(part), lamp);
	if (kept) keepThinFurParts(body, [part]);
	const picture = renderFloats(renderer, scene, camera, target);
	const lit = Array.from({ length: WIDTH }, (_, x) =>
		Array.from({ length: HEIGHT }, (_, y) => picture[4 * (y * WIDTH + x)] ?? 0).filter((value) => value > 0.1),
	);
	return lit.slice(WIDTH / 2 + Math.ceil(0.52 / pixel)).map((column) => column.length);
}
