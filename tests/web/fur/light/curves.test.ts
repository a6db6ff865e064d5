import { readFileSync } from 'node:fs';
import { decode } from 'fast-png';
import { describe, expect, it } from 'vitest';
import { channelOf, type FurAsset } from '../../../../web/fur/format.ts';
import { wayOf } from '../../../../web/fur/light/bent.ts';
import { curvedMoments, curveSkies, curveValues, dipOf, type MeanCurves } from '../../../../web/fur/light/curves.ts';
import { type Direction, relight } from '../../../../web/fur/light/moments.ts';

const golden = (file: string) => new URL(`../../../golden/ptm-6-curves/${file}`, import.meta.url);
const json = (file: string) => JSON.parse(readFileSync(golden(file), 'utf8'));
const floats = (file: string) => {
	const bytes = readFileSync(golden(file));
	return new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
};
const gltf = json('model.gltf');
const fur: FurAsset = gltf.extensions.FUR_ptm_shells;
const [pelt] = fur.pelts;
if (!pelt?.weights || !pelt.fin || !fur.curves) throw new Error('no curves');
const { weights, fin } = pelt;
const means: MeanCurves = { curves: fur.curves, way: wayOf(fur) };
const { bodies, lights }: { bodies: number[]; lights: Direction[] } = json('lights.json');

/** Coefficients of a texel. */
function texels({ planes, scale, bias }: Pick<typeof fin, 'planes' | 'scale' | 'bias'>) {
	const images = planes.map((image) => decode(readFileSync(golden(gltf.images[image].uri))).data);
	return (at: number) =>
		scale.map((lambda, i) => {
			const { plane, channel } = channelOf(i);
			return lambda * ((images[plane]?.[at * 4 + channel] ?? Number.NaN) - (bias[i] ?? Number.NaN));
		});
}

/** Weights at a height, mixed between slabs' middles. */
function weightsAt(s: number): number[] {
	const place = Math.min(Math.max(s * weights.length - 0.5, 0), weights.length - 1);
	const low = Math.min(Math.floor(place), weights.length - 2);
	return (weights[low] ?? []).map((w, q) => w + (place - low) * ((weights[low + 1]?.[q] ?? Number.NaN) - w));
}

describe('curvedMoments', () => {
	it('give the light that numpy expects, on bodies of every radius, above and below the horizon', () => {
		const [expected, coefficients] = [floats('light.f32'), texels(pelt)];
		const count = fur.size * fur.size;
		let [worst, at, below] = [0, 0, 0];
		for (const radius of bodies)
			for (const light of lights)
				for (const row of weights.keys()) {
					const moments = curvedMoments(fur.basis, means, light, weights[row] ?? [], radius);
					for (let texel = 0; texel < count; texel++, at++) {
						const error = relight(coefficients(row * count + texel), moments) - (expected[at] ?? Number.NaN);
						worst = Math.max(worst, Math.abs(error));
						if (light[2] < 0 && (expected[at] ?? 0) > 0.01) below++;
					}
				}
		expect(at).toBe(expected.length);
		expect(below).toBeGreaterThan(1000);
		expect(worst).toBeLessThan(1e-5);
	});

	it("give a fin's light", () => {
		const [expected, coefficients] = [floats('fin.f32'), texels(fin)];
		let [worst, at] = [0, 0];
		for (const radius of bodies)
			for (const light of lights)
				for (let row = 0; row < fin.height; row++) {
					const moments = curvedMoments(fin.basis, means, light, weightsAt((row + 0.5) / fin.height), radius, true);
					for (let column = 0; column < fin.width; column++, at++) {
						const error = relight(coefficients(row * fin.width + column), moments) - (expected[at] ?? Number.NaN);
						worst = Math.max(worst, Math.abs(error));
					}
				}
		expect(at).toBe(expected.length);
		expect(worst).toBeLessThan(1e-5);
	});
});

describe('curveValues', () => {
	it.each([1, 4, 16])('are 0 from where the ball hides the lamp, and not before: β = %d', (radius) => {
		const dip = dipOf(radius);
		expect(dip).toBeCloseTo(Math.sqrt(1 - (radius / (radius + 1)) ** 2), 12);
		expect(curveValues(means.curves, -dip - 1e-6, 1, radius)).toEqual([0, 0, 0]);
		for (const value of curveValues(means.curves, -0.8 * dip, 0, radius)) expect(value).toBeGreaterThan(0);
	});

	it('hold radii within those of the tables', () => {
		expect(curveValues(means.curves, 0.3, 0.5, 0.2)).toEqual(curveValues(means.curves, 0.3, 0.5, 1));
		expect(curveValues(means.curves, 0.3, 0.5, 99)).toEqual(curveValues(means.curves, 0.3, 0.5, 16));
	});
});

describe('curveSkies', () => {
	const expected: { shells: number[][][][]; fins: number[][][][] } = json('environment.json');

	it.each(['shells', 'fins'] as const)('are the integrals over the sphere that numpy finds: %s', (kind) => {
		for (const [b, radius] of bodies.entries()) {
			const skies = curveSkies(kind === 'fins' ? fin.basis : fur.basis, means, radius, kind === 'fins');
			for (const [q, { environment }] of skies.entries())
				for (const [c, row] of environment.entries()) {
					const wanted = expected[kind][b]?.[q]?.[c] ?? [];
					expect(Math.hypot(...row.map((value, j) => value - (wanted[j] ?? Number.NaN)))).toBeLessThan(3e-3);
				}
		}
	});

	it.each([false, true])('have polynomials that leave what none of degree 2 has, fins: %s', (isFin) => {
		const [, curve] = curveSkies(fur.basis, means, 4, isFin);
		const left = (curve?.polynomials ?? []).map(() => new Array<number>(9).fill(0));
		const size = (curve?.polynomials ?? []).map(() => 0);
		const count = 20000;
		for (let i = 0; i < count; i++) {
			const [up, angle] = [1 - (i + 0.5) / count, i * Math.PI * (3 - Math.sqrt(5))];
			const level = Math.sqrt(1 - up * up);
			const [a, b] = [level * Math.cos(angle), level * Math.sin(angle)];
			const [u, v, w] = isFin ? [a, up, b] : [a, b, up];
			const terms = [u * u, v * v, u * v, u, v, 1, w, u * w, v * w];
			// The second curve alone.
			curvedMoments(fur.basis, means, [a, b, up], [0, 1, 0], 4, isFin).forEach((value, c) => {
				const rest = value - terms.reduce((sum, term, j) => sum + term * (curve?.polynomials[c]?.[j] ?? Number.NaN), 0);
				size[c] = (size[c] ?? 0) + value ** 2 / count;
				terms.forEach((term, j) => {
					(left[c] as number[])[j] = (left[c]?.[j] ?? 0) + (rest * term) / count;
				});
			});
		}
		for (const [c, rest] of left.entries())
			for (const value of rest)
				expect(Math.abs(value) / Math.sqrt(size[c] ?? 0), `coefficient ${c}`).toBeLessThan(3e-3);
	});
});
