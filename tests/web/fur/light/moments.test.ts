import { readFileSync } from 'node:fs';
import { decode } from 'fast-png';
import { SphericalHarmonics3, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { channelOf, type FurAsset } from '../../../../web/fur/format.ts';
import {
	BODY_RADIUS,
	type Direction,
	environmentMoments,
	evaluateBasis,
	lightMoments,
	polynomialCurves,
	relight,
	smoothFunctions,
} from '../../../../web/fur/light/moments.ts';

const golden = (name: string, file: string) => new URL(`../../../golden/${name}/${file}`, import.meta.url);

describe.each(['ptm-6', 'eigen-6', 'eigen-3'])('golden %s', (name) => {
	const gltf = JSON.parse(readFileSync(golden(name, 'model.gltf'), 'utf8'));
	const fur: FurAsset = gltf.extensions.FUR_ptm_shells;
	const lights: Direction[] = JSON.parse(readFileSync(golden(name, 'lights.json'), 'utf8'));
	const bytes = readFileSync(golden(name, 'light.f32'));
	const expected = new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));

	it('gives the light that numpy expects, above and below the horizon', () => {
		const { layers, size, basis } = fur;
		const pelt = fur.pelts[0];
		if (!pelt) throw new Error('no pelt');
		const planes = pelt.planes.map((image) => decode(readFileSync(golden(name, gltf.images[image].uri))).data);
		let worst = 0;
		lights.forEach((light, n) => {
			for (let k = 0; k < layers; k++) {
				const moments = lightMoments(basis, light, (k + 0.5) / layers);
				for (let texel = 0; texel < size * size; texel++) {
					const at = k * size * size + texel;
					const coefficients = pelt.scale.map((lambda, i) => {
						const { plane, channel } = channelOf(i);
						return lambda * ((planes[plane]?.[at * 4 + channel] ?? Number.NaN) - (pelt.bias[i] ?? Number.NaN));
					});
					const error = relight(coefficients, moments) - (expected[n * layers * size * size + at] ?? Number.NaN);
					worst = Math.max(worst, Math.abs(error));
				}
			}
		});
		expect(worst).toBeLessThan(1e-4);
	});
});

describe.each(['ptm-6', 'eigen-6', 'eigen-3'])('environmentMoments of %s', (name) => {
	const gltf = JSON.parse(readFileSync(golden(name, 'model.gltf'), 'utf8'));
	const { basis, environment = [] }: FurAsset = gltf.extensions.FUR_ptm_shells;

	it.each([0.1, 0.5, 1])('are those of as many lamps all around, at height %f', (s) => {
		const harmonics = [1.2, 0.2, -0.3, 0.25, 0.15, -0.1, 0.12, 0.18, -0.14];
		const [rings, spokes] = [2000, 32];
		const moments = environment.map(() => 0);
		const values = new Array<number>(9).fill(0);
		for (let r = 0; r < rings; r++) {
			const z = (2 * r + 1) / rings - 1;
			for (let i = 0; i < spokes; i++) {
				const azimuth = (i / spokes) * 2 * Math.PI;
				const level = Math.sqrt(1 - z * z);
				const light: Direction = [level * Math.cos(azimuth), level * Math.sin(azimuth), z];
				SphericalHarmonics3.getBasisAt(new Vector3(...light), values);
				const radiance = values.reduce((sum, value, j) => sum + value * (harmonics[j] ?? 0), 0);
				lightMoments(basis, light, s).forEach((phi, c) => {
					moments[c] = (moments[c] ?? 0) + (radiance * phi * 4 * Math.PI) / (rings * spokes);
				});
			}
		}
		const whole = Math.hypot(...moments);
		environmentMoments(basis, environment, harmonics, s).forEach((moment, c) => {
			expect(Math.abs(moment - (moments[c] ?? Number.NaN)), `moment ${c}`).toBeLessThan(2e-3 * whole);
		});
	});
});

describe('lightMoments', () => {
	const ptm = { kind: 'ptm' } as const;

	it('is continuous across the horizon', () => {
		const above = lightMoments(ptm, [0.6, 0.8, 0], 0.7);
		const below = lightMoments(ptm, [0.6, 0.8, -1e-9], 0.7);
		above.forEach((moment, i) => {
			expect(below[i]).toBeCloseTo(moment, 6);
		});
	});

	it('lets tips see a sunken light longer than roots', () => {
		const sunken: Direction = [Math.sqrt(1 - 0.04), 0, -0.2];
		expect(lightMoments(ptm, sunken, 0.02)[5]).toBe(0);
		expect(lightMoments(ptm, sunken, 1)[5]).toBeGreaterThan(0.5);
	});

	it('is dark from where the ball of fur hides the lamp', () => {
		const dip = Math.sqrt(1 - (BODY_RADIUS / (BODY_RADIUS + 1)) ** 2);
		const z = -dip - 1e-6;
		expect(lightMoments(ptm, [Math.sqrt(1 - z * z), 0, z], 1)).toEqual(
			[0, 0, 0, 0, 0, 0].map((x) => expect.closeTo(x)),
		);
		expect(lightMoments(ptm, [0, 0, -1], 1).every((moment) => moment === 0)).toBe(true);
	});
});

describe('basis', () => {
	it("is eq. (2)'s, without factors 2", () => {
		expect(evaluateBasis({ kind: 'ptm' }, [0.3, -0.5, 0.81])).toEqual(
			[0.09, 0.25, -0.15, 0.3, -0.5, 1].map((x) => expect.closeTo(x)),
		);
	});

	it('has 27 smooth functions at degree 4', () => {
		expect(smoothFunctions([0.3, -0.5, 0.81], 4)).toHaveLength(27);
	});

	it('never gives negative light', () => {
		expect(relight([-1, 0], [1, 0])).toBe(0);
	});
});

describe('polynomialCurves', () => {
	const polynomials = ([u, v, w]: Direction) => [u * u, v * v, u * v, u, v, 1, w, u * w, v * w];

	it('are a PTM itself', () => {
		polynomialCurves({ kind: 'ptm' }).forEach((row, c) => {
			expect(row).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8].map((j) => expect.closeTo(j === c ? 1 : 0, 2)));
		});
	});

	it.each(['eigen-6', 'eigen-3'])('leave of %s what no polynomial of degree 2 has', (name) => {
		const { basis }: FurAsset = JSON.parse(readFileSync(golden(name, 'model.gltf'), 'utf8')).extensions.FUR_ptm_shells;
		const rows = polynomialCurves(basis);
		const count = 5000;
		const left = rows.map(() => new Array<number>(9).fill(0));
		const powers = rows.map(() => [0, 0] as [number, number]);
		for (let i = 0; i < count; i++) {
			const [w, angle] = [1 - (i + 0.5) / count, i * Math.PI * (3 - Math.sqrt(5))];
			const light: Direction = [Math.sqrt(1 - w * w) * Math.cos(angle), Math.sqrt(1 - w * w) * Math.sin(angle), w];
			const p = polynomials(light);
			evaluateBasis(basis, light).forEach((phi, c) => {
				const rest = phi - p.reduce((sum, value, j) => sum + value * (rows[c]?.[j] ?? Number.NaN), 0);
				const power = powers[c] as [number, number];
				power[0] += phi ** 2 / count;
				power[1] += rest ** 2 / count;
				p.forEach((value, j) => {
					(left[c] as number[])[j] = (left[c]?.[j] ?? 0) + (rest * value) / count;
				});
			});
		}
		powers.forEach(([whole, rest], c) => {
			const size = Math.sqrt(whole);
			expect(left[c]?.map((value) => value / size)).toEqual(new Array(9).fill(expect.closeTo(0, 3)));
			expect(Math.sqrt(rest) / size, `curve ${c}`).toBeLessThan(0.5);
		});
	});
});
