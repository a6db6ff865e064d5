/** Runs inside the page: bent fur of a golden asset under a sky, and under as many lamps. */

import {
	EquirectangularReflectionMapping,
	FloatType,
	type Light,
	LightProbe,
	PerspectiveCamera,
	PointLight,
	Scene,
	Vector3,
	WebGLCubeRenderTarget,
	WebGLRenderTarget,
} from 'three';
import { LightProbeGenerator } from 'three/addons/lights/LightProbeGenerator.js';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';
import { furEnvironment } from '../../../web/fur/index.ts';
import { loadFur, renderFloats } from '../../../web/measure/studio.ts';
import { channel, Flat, renderer, uncovered } from './flat.ts';

/** Lamps that a shader has room for on graphics cards, too (1 024 vectors of uniforms), and pictures that are added up. */
const [AT_ONCE, PICTURES] = [128, 4];

/** Texels of a layer as they are seen, [row, column]; NaN where there is no fur. */
export interface UnderDome {
	sky: number[];
	lamps: number[];
}

/**
 * @param combs displacements of the tips along T and B, share of the length
 * @param harmonics of the radiance to order 2, world axes
 * @param radius of the body, lengths of fur of half a unit, where its curvature counts
 * @param attributes further ones, the same at all vertices
 */
export async function underDome(
	url: string,
	layer: number,
	combs: number[][],
	harmonics: number[],
	radius?: number,
	attributes: Record<string, number[]> = {},
): Promise<UnderDome[]> {
	const probe = new LightProbe();
	for (const [j, coefficient] of probe.sh.coefficients.entries()) coefficient.setScalar(harmonics[j] ?? 0);
	const count = AT_ONCE * PICTURES;
	const golden = Math.PI * (3 - Math.sqrt(5));
	const lamps = Array.from({ length: count }, (_, i) => {
		const y = 1 - (2 * i + 1) / count;
		const level = Math.sqrt(1 - y * y);
		const to = new Vector3(level * Math.cos(i * golden), y, level * Math.sin(i * golden));
		const lamp = new PointLight(0xffffff, (probe.sh.getAt(to, new Vector3()).x * 4 * Math.PI) / count, 0, 0);
		lamp.position.copy(to).multiplyScalar(1e4);
		return lamp;
	});
	const flat = new Flat(await loadFur(url));
	if (radius) flat.attribute('curvature', [2 / radius, 2 / radius, 0]);
	for (const [name, value] of Object.entries(attributes)) flat.attribute(name, value);
	flat.add(probe, ...lamps);
	const lit = (on: (light: Light, i: number) => boolean) => {
		for (const [i, light] of [...lamps, probe].entries()) light.visible = on(light, i);
		return [...uncovered(flat.render(layer))];
	};
	const drawn = combs.map((comb) => {
		flat.attribute('_comb', comb);
		const pictures = Array.from({ length: PICTURES }, (_, part) =>
			lit((light, i) => light !== probe && i % PICTURES === part),
		);
		const sum = (texel: number) => pictures.reduce((light, picture) => light + (picture[texel] ?? Number.NaN), 0);
		const sky = lit((light) => light === probe);
		return { sky, lamps: sky.map((_, texel) => sum(texel)) };
	});
	flat.fur.dispose();
	return drawn;
}

/** Three's own harmonics of a picture, by way of its cube map; and what the picture as a background shows towards a light. */
export async function oracle(
	file: string,
): Promise<{ ours: number[][]; three: number[][]; seen: number[]; mean: number }> {
	const texture = await new EXRLoader().setDataType(FloatType).loadAsync(file);
	texture.mapping = EquirectangularReflectionMapping;
	const cube = new WebGLCubeRenderTarget(256, { type: FloatType }).fromEquirectangularTexture(renderer, texture);
	const probe = await LightProbeGenerator.fromCubeRenderTarget(renderer, cube);
	const [lamp] = furEnvironment(texture).lamps;
	const scene = new Scene();
	scene.background = texture;
	const camera = new PerspectiveCamera(8, 1);
	camera.lookAt(lamp?.direction ?? new Vector3());
	const target = new WebGLRenderTarget(16, 16, { type: FloatType });
	const seen = channel(renderFloats(renderer, scene, camera, target), 1);
	const ours = furEnvironment(texture, 0).probe;
	const rows = (from: LightProbe) => from.sh.coefficients.map((coefficient) => coefficient.toArray());
	return {
		ours: rows(ours),
		three: rows(probe),
		seen: [...seen],
		mean: (ours.sh.coefficients[0]?.y ?? 0) / Math.sqrt(4 * Math.PI),
	};
}
