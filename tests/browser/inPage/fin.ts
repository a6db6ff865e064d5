/** Runs inside the page: a fin by itself, part of the stage. */

import {
	BufferAttribute,
	BufferGeometry,
	DirectionalLight,
	FloatType,
	NoBlending,
	OrthographicCamera,
	PerspectiveCamera,
	Scene,
	WebGLRenderTarget,
} from 'three';
import { loadFur, renderFloats } from '../../../web/measure/studio.ts';
import { channel, renderer, uncovered } from './flat.ts';
import { toBase64 } from './Stand.ts';

export const finStage = {
	/**
	 * Fins alone from several sides, those chosen and all of them.
	 *
	 * @returns for each side triangles of the chosen, of all, the number of values in which the two pictures differ, and of those above 0
	 */
	async chosen(url: string, sides: [x: number, y: number, z: number][], parallel: boolean): Promise<number[][]> {
		const fur = await loadFur(url);
		const { fins } = fur;
		if (!fins) throw new Error('no fins');
		const scene = new Scene();
		scene.add(fins, new DirectionalLight(0xffffff, 6));
		const target = new WebGLRenderTarget(160, 160, { type: FloatType });
		const camera = parallel
			? new OrthographicCamera(-1.5, 1.5, 1.5, -1.5, 0.1, 20)
			: new PerspectiveCamera(30, 1, 0.1, 20);
		const figures = sides.map((side) => {
			camera.position.fromArray(side);
			camera.lookAt(0, 0, 0);
			const draw = () => [renderFloats(renderer, scene, camera, target), renderer.info.render.triangles] as const;
			const [some, few] = draw();
			const choose = fins.onBeforeRender;
			fins.onBeforeRender = () => {};
			const [every, all] = draw();
			fins.onBeforeRender = choose;
			return [
				few,
				all,
				some.filter((value, i) => value !== every[i]).length,
				every.filter((value) => value > 0).length,
			];
		});
		fur.dispose();
		return figures;
	},

	/**
	 * The only fin of an asset, one tile wide over the origin in the plane z = 0, under each of the lights.
	 *
	 * @param tilt of the fin about its root, radians
	 * @returns L and coverage, [light, row, column], rows from root to tip
	 */
	async fin(url: string, lights: number[][], tilt = 0): Promise<{ light: string; alpha: string }> {
		const fur = await loadFur(url);
		const { fins, asset } = fur;
		const fin = asset.pelts[0]?.fin;
		if (!fins || !fin) throw new Error('no fins');
		const scene = new Scene();
		const lamp = new DirectionalLight(0xffffff, 4 * Math.PI);
		scene.add(fins, lamp);
		fins.rotation.x = tilt;
		fins.material.blending = NoBlending;
		fur.material.contrast = 1;
		const camera = new OrthographicCamera(-0.5, 0.5, asset.length, 0, 0.1, 10);
		camera.position.z = 5;
		const target = new WebGLRenderTarget(fin.width, fin.height, { type: FloatType });
		const count = fin.width * fin.height;
		const light = new Float32Array(lights.length * count);
		const alpha = new Float32Array(lights.length * count);
		lights.forEach((direction, i) => {
			lamp.position.fromArray(direction);
			const pixels = renderFloats(renderer, scene, camera, target);
			light.set(uncovered(pixels), i * count);
			alpha.set(channel(pixels, 3), i * count);
		});
		fur.dispose();
		return { light: toBase64(new Uint8Array(light.buffer)), alpha: toBase64(new Uint8Array(alpha.buffer)) };
	},

	/**
	 * A fin of a golden asset, laid over the picture as that of `fin` is, with vertices in the middle of every row.
	 *
	 * @returns L, [light, row, column], base64
	 */
	async heights(url: string, lights: number[][], curvature: number[]): Promise<string> {
		const fur = await loadFur(url);
		const { fins, asset } = fur;
		const fin = asset.pelts[0]?.fin;
		if (!fins || !fin) throw new Error('no fins');
		// One quad along x at z = 0.
		const rows = 2 * fin.height;
		const [position, uv, normal, tangent, edge, curved] = [3, 2, 3, 4, 4, 3].map(
			(size) => new BufferAttribute(new Float32Array(2 * (rows + 1) * size), size),
		) as BufferAttribute[];
		const corners: number[] = [];
		for (let i = 0; i < 2 * (rows + 1); i++) {
			position?.setXYZ(i, (i % 2) - 0.5, 0, 0);
			uv?.setXY(i, (i % 2) / (asset.tiles ?? 1), Math.floor(i / 2) / rows / (asset.tiles ?? 1));
			normal?.setXYZ(i, 0, 1, 0);
			tangent?.setXYZW(i, 1, 0, 0, 1);
			edge?.setXYZW(i, 0.5, -0.5, 0, 0);
			curved?.setXYZ(i, curvature[0] ?? 0, curvature[1] ?? 0, curvature[2] ?? 0);
			if (i % 2 === 0 && i < 2 * rows) corners.push(i, i + 1, i + 3, i, i + 3, i + 2);
		}
		const geometry = new BufferGeometry().setIndex(corners);
		for (const [name, attribute] of Object.entries({ position, uv, normal, tangent, _edge: edge, curvature: curved }))
			if (attribute) geometry.setAttribute(name, attribute);
		fins.geometry = geometry;
		fins.position.set(0, 0, 0);
		fins.scale.setScalar(1);
		fins.material.finHeights = asset.tiles ?? 1;
		fins.frustumCulled = false;
		const scene = new Scene();
		const lamp = new DirectionalLight(0xffffff, 4 * Math.PI);
		scene.add(fins, lamp);
		fins.material.blending = NoBlending;
		fur.material.contrast = 1;
		const tall = fur.shells.material.furLength;
		const camera = new OrthographicCamera(-0.5, 0.5, tall, 0, 0.1, 10);
		camera.position.z = 5;
		const target = new WebGLRenderTarget(fin.width, fin.height, { type: FloatType });
		const light = new Float32Array(lights.length * fin.width * fin.height);
		lights.forEach((direction, i) => {
			lamp.position.fromArray(direction);
			light.set(uncovered(renderFloats(renderer, scene, camera, target)), i * fin.width * fin.height);
		});
		fur.dispose();
		return toBase64(new Uint8Array(light.buffer));
	},
};
