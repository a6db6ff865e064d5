/** Tables for terminals and Markdown documents. */

/**
 * Text in columns, for a terminal.
 *
 * @param {string[][]} rows cells; the first column is left-aligned, all others right-aligned
 * @returns {string}
 */
export function table(rows) {
	const widths = rows[0].map((_, c) => Math.max(...rows.map((row) => row[c].length)));
	const line = (/** @type {string[]} */ row) =>
		row.map((cell, c) => (c ? cell.padStart(widths[c]) : cell.padEnd(widths[c]))).join('   ');
	return rows.map((row) => line(row).trimEnd()).join('\n');
}

/**
 * A table in Markdown.
 *
 * @param {string[][]} rows cells; the first row is the head
 * @returns {string}
 */
export function markdown([head, ...rows]) {
	const line = (/** @type {string[]} */ cells) => `| ${cells.join(' | ')} |`;
	return [line(head), `|${head.map((_, i) => (i ? '---:' : '---')).join('|')}|`, ...rows.map(line)].join('\n');
}
