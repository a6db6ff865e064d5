/** The page's own fit of the measured fur: its numbers are those that the baker stored and wrote down. */

import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { lightMoments, relight } from '../../../web/fur/reference.ts';
import {
	curvesFound,
	decibels,
	dequantise,
	Fit,
	PTM,
	polynomial,
	psnr,
	quantise,
	rangeOf,
	relitTexels,
} from '../../../web/learn/data/fit.ts';
import { decodeLayer, type Layer, type LessonRecord } from '../../../web/learn/data/measurements.ts';

const file = (name: string) => readFileSync(new URL(`../../../public/${name}`, import.meta.url));
const record: LessonRecord = JSON.parse(file('lesson/lesson.json').toString());
const planes = record.planes.map((name) => file(`lesson/${name}`));
const layers: Layer[] = record.samples.map((entry, i) => decodeLayer(record, i, file(`lesson/${entry.file}`), planes));
const eq2 = polynomial([0, 1, 2, 3, 4, 5]);
const seen = record.lights.slice(0, record.fitted);
const unseen = record.lights.slice(record.fitted, record.fitted + record.held_out);
const ptm = new Fit(eq2, seen);
const stored = { scale: record.scale, bias: record.bias, top: 255 };
/** Bytes from which a texel is its own: emptier ones take of their neighbours. */
const SOLID = 17;
const solid = ({ alpha, texels }: Layer, t: number) => (alpha[texels[t] as number] as number) >= SOLID;

/** Decibels over the held-out lights, texels weighed by their coverage. */
function judged(layer: Layer, numbers: Float64Array, curves = eq2): number {
	const { light, texels, alpha } = layer;
	const weights = Array.from(texels, (texel) => alpha[texel] as number);
	const errors = unseen.map((direction, n) => {
		const from = (record.fitted + n) * texels.length;
		return 10 ** (-psnr(relitTexels(numbers, curves(direction)), light.subarray(from), weights, record.peak) / 10);
	});
	return decibels(errors.reduce((sum, error) => sum + error, 0) / errors.length);
}

describe('the fit of the page', () => {
	it('has the singular values that the baker has', () => {
		ptm.singularValues.forEach((value, i) => {
			expect(value).toBeCloseTo(record.singular_values[i] ?? Number.NaN, 5);
		});
		expect(ptm.singularValues).toHaveLength(6);
	});

	it.each(layers.map((layer) => [layer.number, layer] as const))(
		'finds the stored bytes of layer %i',
		(_number, layer) => {
			const codes = quantise(ptm.texels(layer.light, layer.texels.length), stored, ptm.gram);
			const off: number[] = [];
			codes.forEach((code, i) => {
				if (solid(layer, Math.floor(i / 6))) off.push(Math.abs(code - (layer.codes[i] as number)));
			});
			expect(off.length).toBeGreaterThan(1000);
			expect(off.filter((steps) => steps === 0).length / off.length).toBeGreaterThan(0.95);
			expect(off.filter((steps) => steps <= 2).length / off.length).toBeGreaterThan(0.995);
		},
	);

	it.each(layers.map((layer) => [layer.number, layer] as const))(
		'relights layer %i as well as the record says, by six numbers or their bytes',
		(number, layer) => {
			const bytes = dequantise(layer.codes, stored);
			expect(judged(layer, bytes)).toBeCloseTo(record.layers.psnr_quantised[number] ?? 0, 1);
			const numbers = ptm.texels(layer.light, layer.texels.length);
			expect(judged(layer, numbers)).toBeCloseTo(record.layers.psnr[number] ?? 0, 1);
		},
	);

	it('does as well with other numbers as the record says', () => {
		const layer = layers[1] as Layer;
		for (const [rows, curvesOf] of [
			[record.ptm, (n: number) => polynomial(record.terms.slice(0, n))],
			[record.eigen_figures, (n: number) => curvesFound(record.eigen, n)],
		] as const)
			for (const { numbers, layers: byLayer } of rows) {
				const curves = curvesOf(numbers);
				const found = new Fit(curves, seen).texels(layer.light, layer.texels.length);
				expect(judged(layer, found, curves)).toBeCloseTo(byLayer?.[layer.number] ?? 0, 1);
			}
	});

	it('loses by rounding what the record says, at any number of bits', () => {
		const layer = layers[1] as Layer;
		const exact = ptm.texels(layer.light, layer.texels.length);
		const weights = Array.from(layer.texels, (texel, t) => (solid(layer, t) ? (layer.alpha[texel] as number) : 0));
		for (const { bits, layers: noise } of record.bits.filter(({ bits: b }) => b <= 8)) {
			const range = rangeOf(stored, bits);
			const rounded = dequantise(quantise(exact, range, ptm.gram), range);
			const lost = unseen.map((light) => {
				const moments = eq2(light);
				const error = psnr(relitTexels(exact, moments), relitTexels(rounded, moments), weights, record.peak);
				return 10 ** (-error / 10);
			});
			const mean = decibels(lost.reduce((sum, error) => sum + error, 0) / lost.length);
			expect(Math.abs(mean - (noise[layer.number] ?? 0))).toBeLessThan(0.3);
		}
	});

	it('gives the light that the library gives, which the shader is held to', () => {
		const layer = layers[0] as Layer;
		const numbers = dequantise(layer.codes, stored);
		for (const light of [...unseen.slice(0, 5), [0, 0, 1] as const]) {
			const relit = relitTexels(numbers, eq2(light));
			for (const t of [0, 7, 500]) {
				const texel = Array.from(numbers.subarray(t * 6, t * 6 + 6));
				expect(relit[t]).toBeCloseTo(relight(texel, lightMoments(PTM, light, 0.5)), 5);
			}
		}
	});
});

describe('the text', () => {
	it('says what was measured', () => {
		const mean = (layer: Layer | undefined, low: number, high: number) => {
			const weights = Array.from(layer?.texels ?? [], (texel) => layer?.alpha[texel] ?? 0);
			const total = weights.reduce((sum, weight) => sum + weight, 0);
			const lamps = record.lights.slice(0, -record.angles.length).map((light, i) => [i, light[2]] as const);
			const some = lamps.filter(([, z]) => z > low && z < high);
			const sum = some.map(([i]) =>
				weights.reduce((s, w, t) => s + w * (layer?.light[i * weights.length + t] ?? 0), 0),
			);
			return sum.reduce((a, b) => a + b, 0) / some.length / total;
		};
		const lost = (layer: Layer | undefined) => 1 - mean(layer, 0, 0.26) / mean(layer, 0.966, 1);
		expect(layers.map(({ number }) => number + 1)).toEqual([4, 8, 12, 14]);
		expect(lost(layers[0])).toBeCloseTo(6 / 7, 1);
		expect(lost(layers[3])).toBeLessThan(2 / 3);
		expect(record.eigen_figures[0]?.numbers).toBe(3);
		expect(record.eigen_figures[0]?.psnr).toBeGreaterThan(record.fit.psnr);
	});
});

describe('the record', () => {
	it('says what the committed models say of themselves', () => {
		const { fin: _, ...fit } = JSON.parse(file('models/torus-512-colour/bake.json').toString()).fit;
		expect(record.fit).toEqual(fit);
		expect(record.bits.find(({ bits }) => bits === 8)?.psnr).toBeCloseTo(fit.psnr_quantised, 3);
		expect(record.ptm.find(({ numbers }) => numbers === 6)?.psnr).toBeCloseTo(fit.psnr, 3);
		expect(record.bound.find(({ numbers }) => numbers === 6)?.psnr).toBeCloseTo(fit.bound.psnr, 3);
	});
});
