/** Decoding of a texel's bytes and coefficients, as uniforms. */

import { type IUniform, type Texture, Vector2, Vector3, Vector4 } from 'three';
import { type Basis, channelOf, type Multiple, type Pelt } from '../format.ts';
import type { MeanCurves } from './curves.ts';
import { horizonMoments, polynomialCurves, smoothSum } from './moments.ts';

/** An asset's planes as texture arrays, a slab per layer. */
export interface FurTextures {
	/** Coefficients (a0, a1, a2, a5); with three coefficients (a0, a1, a2, α). */
	plane0: Texture;
	/** (a3, a4, α, tint). */
	plane1?: Texture | undefined;
	/** The hairs' own colours, sRGB. */
	colour?: Texture | undefined;
	/** Mean tangent of the hairs, for other ways of lighting; mip levels are means, shorter than 1. */
	direction?: Texture | undefined;
}

/** Decoding of texels, and the basis of their coefficients. */
export interface TexelCoding {
	scale: number[];
	bias: number[];
	basis: Basis;
	/** Format 1.x only. */
	environment?: number[][] | undefined;
	/** Format 2.x only. */
	means?: SlabMeanCurves | undefined;
	/** States of the pelt. */
	pelts?: readonly Pelt[] | undefined;
}

/** Mean curves and their weights in the dry pelt, a row per slab. */
export interface SlabMeanCurves extends MeanCurves {
	/** A row per slab, slab 0 first. */
	weights: readonly (readonly number[])[];
	/** Colour of light that has met several hairs. */
	multiple?: Multiple | undefined;
}

/** GLSL of light curves 0..2 and 3..5, as defines; none for a PTM. */
export function basisDefines(basis: Basis): Record<string, string> {
	if (basis.kind === 'ptm') return {};
	const { degree, matrix } = basis;
	const three = (first: number) => smoothSum(degree, [matrix[first], matrix[first + 1], matrix[first + 2]]);
	return { CURVES: '', CURVES_LOW: three(0), CURVES_HIGH: three(3) };
}

/**
 * The light moments' matrices in format 1.x, coefficients 0..2 in `Low` and 3..5 in `High`, absent ones 0.
 *
 * @param fin whether the normal is the frame's second axis, not the third
 */
export function momentUniforms({ environment = [], basis }: TexelCoding, fin: boolean): Record<string, IUniform> {
	const uniforms: Record<string, IUniform> = {};
	const around = horizonMoments(basis, fin ? (psi) => [Math.cos(psi), 0, Math.sin(psi)] : undefined);
	const polynomials = basis.kind === 'eigen' ? polynomialCurves(basis) : [];
	for (const [part, first] of [
		['Low', 0],
		['High', 3],
	] as const) {
		const zeros = new Array<number>(9).fill(0);
		const rows = [0, 1, 2, 3].map((i) => (i < 3 && environment[first + i]) || zeros);
		uniforms[`environment${part}0`] = { value: rows.flatMap((row) => row.slice(0, 4)) };
		uniforms[`environment${part}1`] = { value: rows.flatMap((row) => row.slice(4, 8)) };
		uniforms[`environment${part}2`] = { value: new Vector3(...rows.slice(0, 3).map((row) => row[8] ?? 0)) };
		uniforms[`horizon${part}`] = {
			value: around.map((row) => new Vector3(row[first] ?? 0, row[first + 1] ?? 0, row[first + 2] ?? 0)),
		};
		if (basis.kind === 'eigen') {
			const rows = [0, 1, 2].map((i) => polynomials[first + i] ?? zeros);
			uniforms[`polynomial${part}`] = { value: [0, 3, 6].flatMap((j) => rows.flatMap((row) => row.slice(j, j + 3))) };
		}
	}
	return uniforms;
}

/** Contrast of the texels' light over the stored one's, which six numbers and the mean between texels make evener than the hairs'. */
export const CONTRAST = 1.75;

/** Coefficient of the function 1, the last of a PTM's; -1 in old assets' bases. */
const constantOf = (basis: Basis): number =>
	basis.kind === 'ptm'
		? 5
		: basis.matrix.findIndex(([one, ...rest]) => one === 1 && rest.every((weight) => weight === 0));

/**
 * λ and Ω as multiply-adds on the GPU's 0..1 texels, per plane: a = texel·(255λ) − λΩ.
 *
 * @param contrast of polynomials of format 2.x: their mean over a slab, 1, stays
 */
export function decoder(
	{ scale, bias, basis, means }: TexelCoding,
	contrast: number,
): { scale: Vector4[]; offset: Vector4[] } {
	const constant = constantOf(basis);
	const more = means && constant >= 0 ? contrast : 1;
	const vectors = {
		scale: [new Vector4(0, 0, 0, 0), new Vector4(0, 0, 0, 0)],
		offset: [new Vector4(0, 0, 0, 0), new Vector4(0, 0, 0, 0)],
	};
	scale.forEach((lambda, i) => {
		const { plane, channel } = channelOf(i);
		const mean = i === constant ? 1 - more : 0;
		vectors.scale[plane]?.setComponent(channel, more * lambda * 255);
		vectors.offset[plane]?.setComponent(channel, mean - more * lambda * (bias[i] ?? 0));
	});
	return vectors;
}

/** Values of the uniforms that decode the texels of all furs. @param contrast see `decoder` */
export function codings(furs: readonly TexelCoding[], contrast: number): Record<string, unknown> {
	const each = furs.map((own) => decoder(own, contrast));
	const [{ scale, offset }] = each as [(typeof each)[0]];
	return {
		scale0: scale[0],
		offset0: offset[0],
		scale1: new Vector2(scale[1]?.x, scale[1]?.y),
		offset1: new Vector2(offset[1]?.x, offset[1]?.y),
		codings: each.flatMap(({ scale, offset }) => [scale[0], offset[0], scale[1], offset[1]]),
	};
}
