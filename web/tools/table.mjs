/**
 * Text in columns, for a terminal.
 *
 * @param {string[][]} rows the first column to the left, all others to the right
 * @returns {string}
 */
export function table(rows) {
	const widths = rows[0].map((_, c) => Math.max(...rows.map((row) => row[c].length)));
	const line = (/** @type {string[]} */ row) =>
		row.map((cell, c) => (c ? cell.padStart(widths[c]) : cell.padEnd(widths[c]))).join('   ');
	return rows.map((row) => line(row).trimEnd()).join('\n');
}
