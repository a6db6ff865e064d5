/** Runs inside the page: a furry ball with and without a shadow map. Its answers go to `shadow.spec.ts`. */

import {
	DirectionalLight,
	FloatType,
	Mesh,
	MeshBasicMaterial,
	PerspectiveCamera,
	Scene,
	Sphere,
	SphereGeometry,
	SpotLight,
	Vector3,
	WebGLRenderTarget,
} from 'three';
import { type Fur, fitFurShadow } from '../../../web/fur/index.ts';
import { loadFur, renderFloats } from '../../../web/measure/studio.ts';
import { renderer } from './flat.ts';

const SIZE = 160;

/** Mean brightness of a ball's pixels in bins of n·l from −1 to 1, a tenth each; NaN where there are too few. */
function bins(pixels: Float32Array, radius: number, camera: PerspectiveCamera, light: Vector3): number[] {
	const sums = Array.from({ length: 20 }, () => [0, 0] as [number, number]);
	const [ray, n] = [new Vector3(), new Vector3()];
	for (let i = 0; i < SIZE * SIZE; i++) {
		ray.set((2 * ((i % SIZE) + 0.5)) / SIZE - 1, (2 * (Math.floor(i / SIZE) + 0.5)) / SIZE - 1, 0.5);
		ray.unproject(camera).sub(camera.position).normalize();
		const along = -camera.position.dot(ray);
		const inside = radius ** 2 - camera.position.lengthSq() + along ** 2;
		if (inside < 0.04 * radius ** 2) continue;
		n.copy(camera.position)
			.addScaledVector(ray, along - Math.sqrt(inside))
			.normalize();
		const bin = sums[Math.min(Math.floor(10 * (n.dot(light) + 1)), 19)] as [number, number];
		bin[0] += pixels[4 * i] ?? 0;
		bin[1]++;
	}
	return sums.map(([sum, count]) => (count > 20 ? sum / count : Number.NaN));
}

/**
 * A ball lit from the right, from the eye's side and from above, by lamps far away.
 *
 * @param spot whether the lamp is one of three's spot lights
 * @returns of each eye brightness by n·l without a shadow map, with one, and with a smaller ball before it
 */
export async function terminator(
	url: string,
	spot: boolean,
): Promise<{ plain: number[]; mapped: number[]; behind: number[] }[]> {
	const fur: Fur = await loadFur(url);
	const scene = new Scene();
	scene.add(fur.skin.parent ?? fur.skin);
	(fur.skin as Mesh).material = new MeshBasicMaterial({ color: 0 });
	fur.material.environment = false;
	scene.updateMatrixWorld(true);
	const body = fur.shells.geometry.boundingSphere?.clone().applyMatrix4(fur.shells.matrixWorld) ?? new Sphere();
	const light = new Vector3(1, 0.2, 0).normalize();
	const lamp = spot ? new SpotLight(0xffffff, 4 * Math.PI, 0, 0.3, 0, 0) : new DirectionalLight(0xffffff, 4 * Math.PI);
	lamp.position
		.copy(light)
		.multiplyScalar(12 * body.radius)
		.add(body.center);
	lamp.target.position.copy(body.center);
	const small = new Mesh(
		new SphereGeometry(0.6 * body.radius, 24, 16),
		new MeshBasicMaterial({ colorWrite: false, depthWrite: false }),
	);
	small.position
		.copy(light)
		.multiplyScalar(1.8 * body.radius)
		.add(body.center);
	small.castShadow = true;
	scene.add(lamp, lamp.target, small);
	renderer.shadowMap.enabled = true;
	const target = new WebGLRenderTarget(SIZE, SIZE, { type: FloatType });
	const camera = new PerspectiveCamera(20, 1, 0.1, 100);
	const length = fur.asset.length;
	fur.shells.shellCount = 24;
	const found = [new Vector3(1, 0.1, 0.2), new Vector3(0.1, 0, 1), new Vector3(-0.7, 0.2, 0.7)].map((eye) => {
		camera.position.copy(eye.normalize()).multiplyScalar(6.5 * body.radius);
		camera.lookAt(0, 0, 0);
		camera.updateMatrixWorld();
		const draw = (mapped: boolean, blocked: boolean) => {
			lamp.castShadow = mapped;
			if (mapped && lamp instanceof DirectionalLight)
				fitFurShadow(lamp, new Sphere(body.center, 3 * body.radius), length);
			if (mapped && lamp instanceof SpotLight) {
				lamp.shadow.camera.near = 8 * body.radius;
				lamp.shadow.camera.far = 16 * body.radius;
				lamp.shadow.mapSize.setScalar(512);
				lamp.shadow.radius = (length * 256) / (12 * body.radius * Math.tan(0.3));
			}
			small.visible = blocked;
			return bins(renderFloats(renderer, scene, camera, target), body.radius - 0.5 * length, camera, light);
		};
		return { plain: draw(false, false), mapped: draw(true, false), behind: draw(true, true) };
	});
	renderer.shadowMap.enabled = false;
	fur.dispose();
	target.dispose();
	return found;
}
