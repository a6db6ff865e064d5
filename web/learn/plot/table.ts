/** Table of a texel's six numbers, and eq. (2) with their values. */

import type { Direction } from '../../fur/reference.ts';
import { evaluateBasis } from '../../fur/reference.ts';
import { PTM } from '../data/fit.ts';
import type { TexelState } from '../data/texel.ts';
import type { MeasuredWords } from '../words/index.ts';
import { decimal } from './plot.ts';

/** Terms of eq. (2), in the order of the numbers. */
export const TERMS = ['lᵤ²', 'lᵥ²', 'lᵤlᵥ', 'lᵤ', 'lᵥ', '1'];
const SUB = '₀₁₂₃₄₅';

function add<K extends keyof HTMLElementTagNameMap>(parent: Element, tag: K, text = ''): HTMLElementTagNameMap[K] {
	const element = document.createElement(tag);
	element.textContent = text;
	parent.append(element);
	return element;
}

export class NumberTable {
	readonly #cells: HTMLTableCellElement[][];

	constructor(place: Element, words: MeasuredWords) {
		const table = add(place, 'table');
		table.className = 'numbers';
		const head = add(add(table, 'thead'), 'tr');
		for (const text of [words.term, words.exact, words.byte, words.decoded]) {
			const cell = add(head, 'th', text);
			cell.scope = 'col';
		}
		const body = add(table, 'tbody');
		this.#cells = TERMS.map((term, i) => {
			const row = add(body, 'tr');
			const name = add(row, 'th', `a${SUB[i]} · ${term}`);
			name.scope = 'row';
			return [add(row, 'td'), add(row, 'td'), add(row, 'td')];
		});
	}

	show({ exact, codes, stored }: TexelState): void {
		this.#cells.forEach(([a, byte, decoded], i) => {
			if (a) a.textContent = decimal(exact[i] ?? 0, 4);
			if (byte) byte.textContent = String(codes[i] ?? 0);
			if (decoded) decoded.textContent = decimal(stored[i] ?? 0, 4);
		});
	}
}

/** L by the numbers, by their bytes, and as measured under the nearest lamp. */
export interface Sums {
	light: Direction;
	exact: number;
	stored: number;
	measured: number;
	/** Angle between the light and that lamp, degrees. */
	away: number;
}

export class Substituted {
	readonly #line: HTMLParagraphElement;
	readonly #words: MeasuredWords;

	constructor(place: Element, words: MeasuredWords) {
		this.#line = add(place, 'p');
		this.#line.className = 'sum';
		this.#words = words;
	}

	/** Eq. (2) may break between terms. */
	show({ exact }: TexelState, { light, exact: value, stored, measured, away }: Sums): void {
		const phi = evaluateBasis(PTM, light);
		const parts = exact.map((a, i) => {
			const sign = a < 0 ? '−' : '+';
			const size = decimal(Math.abs(a));
			const factor =
				i === 5 ? '' : ` · ${phi[i] !== undefined && phi[i] < 0 ? `(${decimal(phi[i])})` : decimal(phi[i] ?? 0)}`;
			return `${i === 0 && sign === '+' ? '' : `${sign} `}${size}${factor}`;
		});
		const words = this.#words;
		this.#line.replaceChildren();
		const say = (text: string, tag: 'span' | 'b' = 'span') => {
			add(this.#line, tag, text);
			this.#line.append(' ');
		};
		say(`L(${decimal(light[0])}, ${decimal(light[1])}) =`);
		for (const part of parts) say(part);
		say(`= ${decimal(value)}`, 'b');
		for (const part of words.beside(decimal(stored), decimal(measured), decimal(away, 0))) say(part);
		this.#line.dataset.exact = String(value);
		this.#line.dataset.stored = String(stored);
	}
}

/** Table of λ and Ω of the six numbers. */
export class RangeTable {
	readonly #cells: HTMLTableCellElement[][];

	constructor(place: Element, words: MeasuredWords) {
		const table = add(place, 'table');
		table.className = 'numbers';
		const head = add(add(table, 'thead'), 'tr');
		for (const text of [words.term, words.lambda, words.omega]) add(head, 'th', text).scope = 'col';
		const body = add(table, 'tbody');
		this.#cells = TERMS.map((term, i) => {
			const row = add(body, 'tr');
			add(row, 'th', `a${SUB[i]} · ${term}`).scope = 'row';
			return [add(row, 'td'), add(row, 'td')];
		});
	}

	show({ scale, bias }: { scale: readonly number[]; bias: readonly number[] }): void {
		this.#cells.forEach(([lambda, omega], i) => {
			if (lambda) lambda.textContent = decimal(scale[i] ?? 0, 4);
			if (omega) omega.textContent = decimal(bias[i] ?? 0, 1);
		});
	}
}
