/** Runs inside the page: a square of two furs, and the same in one, from straight above and askew. For `regions.spec.ts`. */

import {
	AmbientLight,
	type Box3,
	type BufferAttribute,
	type Color,
	DirectionalLight,
	FloatType,
	Group,
	OrthographicCamera,
	Scene,
	Vector3,
	WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import { dressFur, type Fur, furMethod } from '../../../web/fur/index.ts';
import { loadFur, renderFloats } from '../../../web/measure/studio.ts';
import { psnr } from './Stand.ts';

const SIZE = 256;
const SHELLS = 12;
const renderer = new WebGLRenderer({ antialias: false });
const gl = renderer.getContext() as WebGL2RenderingContext;

/** A change of the bounds of a vertex' hairs. */
type Change = (lower: number, upper: number, fur: number) => [number, number];

const CHANGES: Record<string, Change> = {
	soft: (lower, upper) => [lower, upper],
	hard: (lower, upper, fur) => (fur === 0 ? [0, Math.round(upper)] : [Math.round(lower), 1]),
	thin: (lower, upper, fur) => (fur === 0 ? [0, upper * upper] : [Math.sqrt(lower), 1]),
	double: () => [0, 1],
};

class Square {
	readonly fur: Fur;
	readonly #scene = new Scene();
	readonly #camera = new OrthographicCamera(-0.5, 0.5, 0.5, -0.5, 0.1, 10);
	readonly #target = new WebGLRenderTarget(SIZE, SIZE, { type: FloatType });

	constructor(fur: Fur) {
		this.fur = fur;
		const lamp = new DirectionalLight(0xffffff, 6);
		const group = new Group().add(fur.skin.parent ?? fur.skin);
		group.updateMatrixWorld(true);
		this.#scene.add(group, lamp, lamp.target, new AmbientLight(0xffffff, 1));
		this.look(0);
		const n = this.#normal();
		lamp.position
			.copy(n)
			.multiplyScalar(5)
			.add(new Vector3(2, 1, 1));
	}

	#normal(): Vector3 {
		const normals = this.fur.shells.geometry.getAttribute('normal') as BufferAttribute;
		return new Vector3().fromBufferAttribute(normals, 0).transformDirection(this.fur.shells.matrixWorld);
	}

	/** Look from above, x to the right. @param slant towards the camera's lower side, of the distance */
	look(slant: number): this {
		const n = this.#normal();
		const up = new Vector3().crossVectors(n, new Vector3(1, 0, 0));
		const { shells } = this.fur;
		shells.geometry.computeBoundingBox();
		const middle = shells.localToWorld((shells.geometry.boundingBox as Box3).getCenter(new Vector3()));
		this.#camera.up.copy(up);
		this.#camera.position
			.copy(middle)
			.addScaledVector(n, 5)
			.addScaledVector(up, -5 * slant);
		this.#camera.lookAt(middle);
		return this;
	}

	draw(visible = true): Float32Array {
		this.fur.shells.visible = visible;
		this.fur.shells.shellCount = SHELLS;
		this.#scene.updateMatrixWorld();
		return renderFloats(renderer, this.#scene, this.#camera, this.#target);
	}
}

/** The coat red, the region green: their light in each column over that of the same fur in white. */
function shares(square: Square, white: Float32Array): { red: number[]; green: number[] } {
	const pixels = square.draw();
	const [red, green, all] = [0, 1, 2].map(() => new Float64Array(SIZE)) as [Float64Array, Float64Array, Float64Array];
	for (let i = 0; i < SIZE * SIZE; i++) {
		const column = i % SIZE;
		red[column] = (red[column] as number) + (pixels[4 * i] as number);
		green[column] = (green[column] as number) + (pixels[4 * i + 1] as number);
		all[column] = (all[column] as number) + (white[4 * i] as number);
	}
	const over = (part: Float64Array) => Array.from(part, (sum, column) => sum / (all[column] as number));
	return { red: over(red), green: over(green) };
}

const paint = (colours: readonly (Color | undefined)[], rgb: readonly [number, number, number]) => {
	for (const colour of colours) colour?.setRGB(...rgb);
};

/** @returns psnr of the two squares, from above and askew; and for each change of the bounds, shares by column */
export async function border(several: string, whole: string) {
	const [two, one] = await Promise.all([several, whole].map(async (url) => new Square(await loadFur(url))));
	if (!two || !one) throw new Error('nothing to compare');
	const alike = [0, 0.8].map((slant) => psnr(two.look(slant).draw(), one.look(slant).draw()));
	const light = (backlight: number, gloss: number) => {
		for (const { fur } of [two, one]) Object.assign(fur.material, { backlight, gloss });
	};
	light(40, 0.5);
	const shining = psnr(two.draw(), one.draw());
	light(0, 0);
	const calls = [one, two].map((square) => {
		square.draw(false);
		const bare = renderer.info.render.calls;
		square.draw();
		return renderer.info.render.calls - bare;
	});
	const rivals = (['unlit', 'lengyel'] as const).map((name) => {
		const [first, second] = [two, one].map((square) => {
			const method = furMethod(square.fur, name);
			method.apply();
			const pixels = square.look(0.8).draw();
			method.dispose();
			return pixels;
		});
		return psnr(first as Float32Array, second as Float32Array);
	});
	const dressed = dressFur(two.fur, one.fur);
	two.fur.visible = false;
	dressed.shells.shellCount = SHELLS;
	const worn = psnr(two.look(0.8).draw(), one.look(0.8).draw());
	dressed.visible = false;
	two.fur.visible = true;

	for (const square of [one, two])
		square.fur.skin.traverse((part) => {
			part.visible = false;
		});
	const white = one.look(0).draw();
	two.look(0);
	const { material, geometry } = two.fur.shells;
	paint([material.root, material.tip, material.tip2], [1, 0, 0]);
	paint(two.fur.material.uniforms.regionRamps?.value.slice(3), [0, 1, 0]);
	const region = geometry.getAttribute('_region') as BufferAttribute;
	const slope = geometry.getAttribute('regionSlope') as BufferAttribute;
	const [stored, grown] = [region.clone(), slope.clone()];
	const found: Record<string, { red: number[]; green: number[] }> = {};
	for (const [name, change] of Object.entries(CHANGES)) {
		for (let i = 0; i < region.count; i++) {
			const bounds = change(stored.getX(i), stored.getY(i), Math.round(255 * stored.getZ(i)));
			region.setXY(i, ...bounds);
			for (let c = 0; c < 4; c++) slope.setComponent(i, c, name === 'soft' ? grown.getComponent(i, c) : 0);
		}
		region.needsUpdate = slope.needsUpdate = true;
		found[name] = shares(two, white);
	}
	return { alike, shining, calls, rivals, worn, found, error: gl.getError() };
}

/**
 * A body of several furs of the same hairs and its picture beside that of one; each fur in white and the rest in black.
 *
 * @returns psnr from above and askew; per fur its light over all light, in the four quarters: left and right below, then above
 */
export async function quarters(several: string, whole: string) {
	const [many, one] = await Promise.all([several, whole].map(async (url) => new Square(await loadFur(url))));
	if (!many || !one) throw new Error('nothing to compare');
	const light = (backlight: number) => {
		for (const { fur } of [many, one]) Object.assign(fur.material, { backlight });
	};
	const alike = [0, 40].flatMap((backlight) => {
		light(backlight);
		return [0, 0.8].map((slant) => psnr(many.look(slant).draw(), one.look(slant).draw()));
	});
	light(0);
	for (const square of [one, many])
		square.fur.skin.traverse((part) => {
			part.visible = false;
		});
	const quarter = (pixels: Float32Array) => {
		const sums = [0, 0, 0, 0];
		for (let i = 0; i < SIZE * SIZE; i++) {
			const at = Number(i % SIZE >= SIZE / 2) + 2 * Number(i >= (SIZE * SIZE) / 2);
			sums[at] = (sums[at] as number) + (pixels[4 * i] as number);
		}
		return sums;
	};
	const white = quarter(one.look(0).draw());
	many.look(0);
	const { material } = many.fur.shells;
	const colours: Color[] = material.uniforms.regionRamps?.value;
	const furs = Array.from({ length: colours.length / 3 }, (_, fur) =>
		fur ? colours.slice(3 * fur, 3 * fur + 3) : [material.root, material.tip, material.tip2],
	);
	const shares = furs.map((mine) => {
		paint(furs.flat(), [0, 0, 0]);
		paint(mine, [1, 1, 1]);
		return quarter(many.draw()).map((sum, i) => sum / (white[i] as number));
	});
	return { alike, shares, error: gl.getError() };
}
