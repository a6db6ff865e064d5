/**
 * `npm run bench [-- --json FILE --baseline FILE --browser NAME|PATH --rounds N --size WxH --parts LIST --methods LIST
 * --triangles LIST --quick --gpu --markdown]`: every method on every torus, in turn in a browser; prints the tables, and
 * beside a baseline what has become slower or faster.
 */
import { existsSync, writeFileSync } from 'node:fs';
import { dirname, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { ensureBrowser } from '../browser.mjs';
import { ensureNode } from '../environment.mjs';
import { command, Failure, say } from '../process.mjs';
import { serve } from '../site/vite.mjs';
import { against, readBaseline } from './baseline.mjs';
import { findProgram, launch } from './launch.mjs';
import { markdown, table } from './table.mjs';

/** @import { BenchFigures } from '../../measure/bench/results.ts' */
/** @import { Table } from '../../bench/tables.ts' */

/** @typedef {{ title: string, tables: Table[] }} Section */
/** Message of the page: progress, result or error. */
/** @typedef {{ doing?: string, error?: string, figures?: BenchFigures, sections?: Section[] }} Message */

const options = /** @type {const} */ ({
	json: { type: 'string' },
	baseline: { type: 'string' },
	browser: { type: 'string' },
	rounds: { type: 'string' },
	size: { type: 'string' },
	parts: { type: 'string' },
	methods: { type: 'string' },
	triangles: { type: 'string' },
	quick: { type: 'boolean' },
	gpu: { type: 'boolean' },
	markdown: { type: 'boolean' },
});
const called = process.env.INIT_CWD ?? process.cwd();
const ENDPOINT = '/bench-says';
/** Milliseconds of silence after which the browser counts as stuck. */
const SILENCE = 180_000;

const LISTS = {
	parts: ['results', 'layers', 'costs', 'curves', 'card'],
	methods: ['unlit', 'lengyel', 'shadow-layers', 'ptm', 'ptm3', 'ptm-colour'],
	triangles: ['512', '4608', '16896'],
};

/**
 * Query of the page's address.
 *
 * @param {Record<string, string | boolean | undefined>} values
 */
function queryOf({ rounds, size, quick, ...others }) {
	if (rounds !== undefined && !/^[1-9]\d?$/.test(`${rounds}`))
		throw new Failure(`--rounds: got ${rounds}, expected 1 to 99`);
	const sides = size === undefined ? [] : (/^(\d{1,4})x(\d{1,4})$/.exec(`${size}`) ?? [0, 0, 0]).slice(1).map(Number);
	if (sides.some((side) => side < 16))
		throw new Failure(`--size: got ${size}, expected width and height, 16 to 9999 pixels, as in 1280x720`);
	/** @type {typeof others} */
	const given = { rounds, size, quick: quick ? '1' : undefined };
	for (const [name, all] of Object.entries(LISTS)) {
		given[name] = others[name];
		const odd = `${others[name] ?? all}`.split(',').some((item) => !all.includes(item));
		if (odd) throw new Failure(`--${name}: got ${others[name]}, expected some of ${all.join(',')}`);
	}
	const query = new URLSearchParams({ run: '1', post: ENDPOINT, lang: 'en' });
	for (const [name, value] of Object.entries(given)) if (value !== undefined) query.set(name, `${value}`);
	return query;
}

/**
 * Serves the site and receives the page's messages.
 *
 * @param {(message: Message) => void} heard
 */
function serveListening(heard) {
	return serve([
		{
			name: 'furbake-bench',
			configureServer({ middlewares }) {
				middlewares.use(ENDPOINT, (request, response) => {
					let text = '';
					request.setEncoding('utf8');
					request.on('data', (chunk) => {
						text += chunk;
					});
					request.on('end', () => {
						response.end();
						if (request.method === 'POST') heard(JSON.parse(text));
					});
				});
			},
		},
	]);
}

/**
 * @param {string} program
 * @param {URLSearchParams} query
 * @param {boolean} gpu
 * @returns {Promise<{ figures: BenchFigures, sections: Section[] }>}
 */
async function measure(program, query, gpu) {
	/** @type {(message: Message) => void} */
	let heard = () => {};
	const server = await serveListening((message) => heard(message));
	const browser = launch(program, `${server.url}bench.html?${query}`, { gpu });
	try {
		return await new Promise((resolve, reject) => {
			const stuck = () => reject(new Failure(`${program}: no word from the page for ${SILENCE / 60_000} minutes`));
			let silence = setTimeout(stuck, SILENCE);
			const settle = () => clearTimeout(silence);
			heard = ({ doing, error, figures, sections }) => {
				settle();
				if (figures && sections) return resolve({ figures, sections });
				if (error) return reject(new Failure(`the page could not measure: ${error}`));
				silence = setTimeout(stuck, SILENCE);
				if (doing) progress(doing);
			};
			void browser.ended.then((words) => {
				settle();
				reject(new Failure(`${program}: ${words}`));
			});
			for (const signal of /** @type {const} */ (['SIGINT', 'SIGTERM']))
				process.once(signal, () => {
					settle();
					reject(new Failure('stopped'));
				});
		});
	} finally {
		progress('');
		await browser.close();
		await server.close();
	}
}

let tenth = -1;
/** Shows progress: one changing line on a terminal, elsewhere a line per tenth. @param {string} words `12 %: ...` */
function progress(words) {
	if (process.stderr.isTTY) {
		process.stderr.write(`\r\u001b[K${words}`);
		return;
	}
	const now = Math.floor(Number.parseInt(words, 10) / 10);
	if (now > tenth) say(words);
	if (now > tenth) tenth = now;
}

/**
 * @param {BenchFigures} figures
 * @param {Section[]} sections
 * @param {(rows: string[][]) => string} written
 */
function report({ device, browser, cores, seconds }, sections, written) {
	const machine = `${device}, ${cores} cores, ${Math.round(seconds / 60)} min\n${browser}`;
	const parts = sections.flatMap(({ title, tables }) =>
		tables.map(({ caption, head, rows }) => `${title}: ${caption}\n\n${written([head, ...rows])}`),
	);
	return [machine, ...parts].join('\n\n');
}

await command(async () => {
	let values;
	try {
		({ values } = parseArgs({ options }));
	} catch (error) {
		throw new Failure(/** @type {Error} */ (error).message);
	}
	const query = queryOf(values);
	// Fail before the measurement, not a quarter of an hour later.
	if (values.json && !existsSync(dirname(resolve(called, values.json))))
		throw new Failure(`--json: ${values.json}: expected a file in a folder that is there`);
	const baseline = values.baseline === undefined ? undefined : readBaseline(resolve(called, values.baseline));
	const named = values.browser === undefined ? undefined : findProgram(values.browser);
	await ensureNode();
	const program = named ?? (await ensureBrowser());
	say(`measuring in ${program}; with software rendering that takes about ${values.quick ? '2' : '15'} minutes`);
	const { figures, sections } = await measure(program, query, values.gpu ?? false);
	const written = values.markdown ? markdown : table;
	console.log(report(figures, sections, written));
	if (baseline) console.log(`\n${against(baseline, figures, written)}`);
	if (values.json) {
		try {
			writeFileSync(resolve(called, values.json), `${JSON.stringify(figures, null, '\t')}\n`);
		} catch (error) {
			throw new Failure(`--json: ${/** @type {Error} */ (error).message}`);
		}
	}
});
