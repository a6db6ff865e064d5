/** The table of parameters for the docs, in Markdown. */

import { en } from '../words/en.ts';
import { NAMES, parameters } from './parameters.ts';

/** Lines between which a page of the docs has the table. */
export const MARKERS = ['<!-- parameters -->', '<!-- /parameters -->'] as const;

/** A row per parameter: an example, what it means, which values there are, and its controls in the panel. */
export function addressTable(): string {
	const rows = NAMES.map((name) => {
		const { value, doc, controls = [] } = parameters[name];
		const [example, meaning] = doc;
		const wanted: string | ((...limits: string[]) => string) = en.expected[value.kind];
		const values = typeof wanted === 'string' ? wanted : wanted(...value.limits);
		return [`\`${name}=${example}\``, meaning, values, controls.map(({ label }) => en[label]).join(', ')];
	});
	const heads = ['in the address', 'shows', 'values', 'in the panel'];
	return [heads, heads.map(() => '---'), ...rows].map((cells) => `| ${cells.join(' | ')} |`).join('\n');
}

/** @returns the page with the table of today between its markers */
export function withAddressTable(page: string): string {
	const [begin, end] = MARKERS.map((marker) => page.indexOf(marker)) as [number, number];
	if (begin < 0 || end < begin) throw new Error(`got a page without ${MARKERS.join(' … ')}, expected both markers`);
	return `${page.slice(0, begin + MARKERS[0].length)}\n${addressTable()}\n${page.slice(end)}`;
}
