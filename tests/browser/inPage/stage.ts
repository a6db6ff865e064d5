/** Runs inside the page: the library alone, without the demo, on assets of the tests. Its answers go to `fur.spec.ts`. */

import {
	AmbientLight,
	BufferAttribute,
	DirectionalLight,
	HemisphereLight,
	LightProbe,
	LinearMipmapLinearFilter,
	type Texture,
} from 'three';
import type { Fur } from '../../../web/fur/index.ts';
import { skyShares } from '../../../web/fur/light/multiple.ts';
import { measureEnvironment } from '../../../web/measure/environment.ts';
import { measureFins } from '../../../web/measure/fins.ts';
import { loadFur, Studio } from '../../../web/measure/studio.ts';
import { oracle, underDome } from './dome.ts';
import { finStage } from './fin.ts';
import { channel, Flat, readArray, renderer, uncovered } from './flat.ts';
import { toBase64 } from './Stand.ts';

/** How a layer is lit. */
interface Look {
	lamp?: number[];
	ambient?: number;
	tip2?: [number, number, number];
	blue?: boolean;
	perFragment?: boolean;
}

const stage = {
	/** Both planes as the GPU holds them, base64. */
	async planes(url: string): Promise<string[]> {
		const { asset, shells, dispose } = await loadFur(url);
		const planes = ['plane0', 'plane1'].flatMap((name) => shells.material.uniforms[name]?.value ?? []);
		const bytes = planes.map((texture: Texture) => toBase64(readArray(texture, asset.size, asset.layers)));
		dispose();
		return bytes;
	},

	/** The directions as the GPU holds them, base64; of the rest what must be so; how many textures are left at the end. */
	async directions(url: string): Promise<{ bytes: string; colorSpace: string; levels: number; left: number }> {
		const { asset, textures, shells, dispose } = await loadFur(url);
		const texture = textures.direction;
		if (!texture) throw new Error('no directions');
		if (Object.values(shells.material.uniforms).some(({ value }) => value === texture)) throw new Error('a uniform');
		const before = renderer.info.memory.textures;
		const bytes = toBase64(readArray(texture, asset.size, asset.layers));
		dispose();
		const left = renderer.info.memory.textures - before;
		return { bytes, colorSpace: texture.colorSpace, levels: texture.mipmaps?.length ?? 0, left };
	},

	/** The light of every texel of a golden asset under each of the lights, base64 of float32 [light, layer, row, column]. */
	async light(url: string, lights: number[][], given: Record<string, number[]> = {}, contrast = 1): Promise<string> {
		const flat = new Flat(await loadFur(url));
		flat.fur.material.contrast = contrast;
		for (const [name, value] of Object.entries(given)) flat.attribute(name, value);
		const lamp = new DirectionalLight(0xffffff, 4 * Math.PI);
		flat.add(lamp, lamp.target);
		const { layers, size } = flat.fur.asset;
		const all = new Float32Array(lights.length * layers * size * size);
		lights.forEach((light, i) => {
			lamp.position.copy(flat.world(light)).multiplyScalar(10);
			for (let k = 0; k < layers; k++) all.set(flat.light(k), (i * layers + k) * size * size);
		});
		flat.fur.dispose();
		return toBase64(new Uint8Array(all.buffer));
	},

	/** Layer 0 under an environment: three's light probe of these 9 world-space harmonics, ambient and hemisphere lights. */
	async environment(
		url: string,
		probe: number[],
		ambient: number,
		hemisphere: { sky: number; ground: number; up: number[] },
	): Promise<{ light: number[]; frame: number[][] }> {
		const flat = new Flat(await loadFur(url));
		const harmonics = new LightProbe();
		for (const [j, coefficient] of harmonics.sh.coefficients.entries()) coefficient.setScalar(probe[j] ?? 0);
		const dome = new HemisphereLight();
		dome.color.setScalar(hemisphere.sky);
		dome.groundColor.setScalar(hemisphere.ground);
		dome.position.fromArray(hemisphere.up);
		flat.add(harmonics, new AmbientLight(0xffffff, ambient), dome);
		const light = Array.from(flat.light(0), (radiance) => radiance * 4 * Math.PI);
		const frame = [
			[1, 0, 0],
			[0, 1, 0],
			[0, 0, 1],
		].map((axis) => flat.world(axis).toArray());
		flat.fur.dispose();
		return { light, frame };
	},

	/** A layer of bent hairs under a sky and under as many lamps. */
	dome: underDome,

	/** How many shader programs there are after each of these assets has been drawn, the ones before still at hand. */
	async programs(urls: string[]): Promise<number[]> {
		const drawn: Fur[] = [];
		const counts: number[] = [];
		for (const url of urls) {
			const flat = new Flat(await loadFur(url));
			flat.render(0);
			drawn.push(flat.fur);
			counts.push(renderer.info.programs?.length ?? 0);
		}
		for (const fur of drawn) fur.dispose();
		return counts;
	},

	/**
	 * Coverage of one shell of a golden asset, [row, column], base64.
	 *
	 * @param shift of the look-up, tile widths along u and v
	 */
	async shell(url: string, shell: number, count: number, [u, v]: number[]): Promise<string> {
		const flat = new Flat(await loadFur(url));
		const { asset, shells } = flat.fur;
		const uv = shells.geometry.getAttribute('uv');
		const moved = new Float32Array(uv.count * 2);
		for (let i = 0; i < uv.count; i++) {
			moved[2 * i] = uv.getX(i) + (u ?? 0) / (asset.tiles ?? 1);
			moved[2 * i + 1] = uv.getY(i) + (v ?? 0) / (asset.tiles ?? 1);
		}
		shells.geometry.setAttribute('uv', new BufferAttribute(moved, 2));
		const alpha = channel(flat.render(shell, count), 3);
		flat.fur.dispose();
		return toBase64(new Uint8Array(alpha.buffer));
	},

	/**
	 * The same view of a model under its lamp and sky, once per setting.
	 *
	 * @returns pixels (rgba as floats, premultiplied, base64), and how many shells there were, and were drawn
	 */
	async pictures(
		url: string,
		size: number,
		settings: {
			shells: number | 'auto';
			lampsPerFragment?: boolean;
			distance?: number;
			samples?: number;
			skin?: boolean;
			/** Whether lamps and sky are found once per vertex of the body, not at every shell. */
			bodyLight?: boolean;
			trim?: number;
			/** Whether hairs have a comb, of no length. */
			combed?: boolean;
			/** Whether coefficients are a mixture of two mip levels. */
			mixed?: boolean;
			merging?: number;
		}[],
	): Promise<{ rgba: string; shells: number; drawn: number }[]> {
		const studio = new Studio(renderer, await loadFur(url), size, size);
		const [points] = studio.fur.shells.children;
		const pictures = settings.map((setting) => {
			const { shells, lampsPerFragment = false, distance = 1, samples = 1, bodyLight = true, trim = 1 } = setting;
			studio.look(-0.4, 1.2, distance);
			studio.showFur(shells, true);
			if (points) points.visible = bodyLight;
			const { geometry } = studio.fur.shells;
			if (setting.combed)
				geometry.setAttribute(
					'_comb',
					new BufferAttribute(new Float32Array(geometry.getAttribute('position').count * 3), 3),
				);
			if (setting.mixed) {
				studio.fur.textures.plane0.minFilter = LinearMipmapLinearFilter;
				studio.fur.textures.plane0.needsUpdate = true;
			}
			studio.fur.length = trim * studio.fur.asset.length;
			studio.fur.shells.material.lampsPerFragment = lampsPerFragment;
			studio.fur.shells.merging = setting.merging ?? 0;
			const rgba = toBase64(new Uint8Array(studio.draw(samples).buffer));
			return { rgba, shells: studio.fur.shells.shellCount, drawn: studio.fur.shells.drawnShells };
		});
		studio.dispose();
		return pictures;
	},

	/** Of every slab the share of the sky's light that has met several hairs. @param radius of the body, lengths of fur */
	async skyShares(url: string, radius: number): Promise<number[]> {
		const { asset, dispose } = await loadFur(url);
		const { multiple, weights = [] } = asset.pelts[0] ?? {};
		if (!multiple || !asset.curves) throw new Error('not told');
		const shares = skyShares(multiple, { curves: asset.curves, way: [0, 1] }, weights, radius);
		dispose();
		return shares;
	},

	/**
	 * One layer of a golden asset whose vertices all have these attributes: red channel and coverage per texel.
	 *
	 * @param look blue: whether a blue lamp stands beside the white one; the hues of all are then summed apart
	 */
	async vertices(
		url: string,
		layer: number,
		attributes: Record<string, number[]>,
		{ lamp, ambient = 0, tip2 = [1, 1, 1], blue = false, perFragment = false }: Look,
	): Promise<{ light: number[]; alpha: number[] }> {
		const flat = new Flat(await loadFur(url));
		for (const [name, value] of Object.entries(attributes)) flat.attribute(name, value);
		flat.fur.shells.material.tip2.setRGB(...tip2);
		flat.add(new AmbientLight(0xffffff, ambient));
		if (lamp) {
			const light = new DirectionalLight(0xffffff, 4 * Math.PI);
			light.position.copy(flat.world(lamp));
			flat.add(light);
			const other = new DirectionalLight(0x0000ff, blue ? 1 : 0);
			other.position.copy(light.position);
			flat.add(other);
		}
		flat.fur.material.lampsPerFragment = perFragment;
		const pixels = flat.render(layer);
		flat.fur.dispose();
		return { light: [...uncovered(pixels)], alpha: [...channel(pixels, 3)] };
	},

	...finStage,

	/** The top layer of a golden asset under a lamp and a sky, lamps summed per vertex and per fragment. */
	async bothWays(url: string): Promise<number[][]> {
		const flat = new Flat(await loadFur(url));
		flat.attribute('curvature', [0.7, 0.2, 0.1]);
		flat.attribute('_comb', [0.2, 0.3]);
		const lamps = [
			[0.6, 0.6, 0.5],
			[-0.9, 0.3, -0.1],
		].map((to) => {
			const lamp = new DirectionalLight(0xffffff, 4 * Math.PI);
			lamp.position.copy(flat.world(to));
			return lamp;
		});
		flat.add(new AmbientLight(0xffffff, 1), ...lamps);
		const both = [false, true].map((on) => {
			flat.fur.shells.material.lampsPerFragment = on;
			return [...flat.light(3)].filter((value) => !Number.isNaN(value));
		});
		flat.fur.dispose();
		return both;
	},

	/**
	 * A whole model from the front, centred and filling a square picture, lit from the left and by the sky.
	 *
	 * @param wanted 0 shells: none
	 * @returns per drawing its pixels (rgba as floats, premultiplied, base64) and what was drawn of fins and shells in
	 * which order; how many pixels a unit of the model is wide at its centre
	 */
	async drawings(
		url: string,
		size: number,
		wanted: { shells: number; fins: boolean; azimuth?: number }[],
	): Promise<{ pictures: string[]; orders: string[][]; scale: number; radius: number; length: number }> {
		const studio = new Studio(renderer, await loadFur(url), size, size);
		const { fur, scale, radius } = studio;
		let order: string[] = [];
		for (const part of [fur.fins, fur.shells]) if (part) part.onBeforeRender = () => order.push(part.name);
		const pictures: string[] = [];
		const orders: string[][] = [];
		for (const { shells, fins, azimuth } of wanted) {
			studio.showFur(shells, fins);
			studio.look(azimuth);
			order = [];
			pictures.push(toBase64(new Uint8Array(studio.draw().buffer)));
			orders.push(order);
		}
		studio.dispose();
		return { pictures, orders, scale, radius, length: fur.asset.length };
	},

	/** The figures of `npm run fins`. */
	fins: measureFins,

	/** The figures of `npm run environment`. */
	surroundings: measureEnvironment,

	oracle,

	/** The message with which an asset is refused, or 'loaded'. */
	async refusal(url: string): Promise<string> {
		try {
			await loadFur(url);
			return 'loaded';
		} catch (error) {
			return (error as Error).message;
		}
	},
};

export type Stage = typeof stage;
Object.assign(window, { stage });
