/**
 * `npm test [-- --all]`: every test of both wings, unit and browser. All three runners run even after failures; the last line
 * counts. With `--all` proofs that take minutes are whole: their tests read `FURBAKE_TEST_ALL`.
 */
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { ensureBrowser } from './browser.mjs';
import { ensureNode, ensurePython, python } from './environment.mjs';
import { command, root, run } from './process.mjs';

/**
 * @typedef {object} Count
 * @property {number} passed
 * @property {number} failed
 * @property {number} [again] of those that passed, those that did so at the second try
 */

/** @param {string} xml JUnit, as pytest writes it; @returns {Count} */
function countJunit(xml) {
	const suite = /<testsuite [^>]*>/.exec(xml)?.[0] ?? '';
	const number = (/** @type {string} */ name) => Number(new RegExp(` ${name}="(\\d+)"`).exec(suite)?.[1] ?? 0);
	const failed = number('failures') + number('errors');
	return { passed: number('tests') - failed - number('skipped'), failed };
}

/** @param {string} json Vitest's report; @returns {Count} */
function countVitest(json) {
	const { numPassedTests, numFailedTests, testResults } = JSON.parse(json);
	// A file that fails to load has no failed test in it.
	const broken = testResults.filter(
		(/** @type {any} */ file) => file.status === 'failed' && !file.assertionResults.length,
	);
	return { passed: numPassedTests, failed: numFailedTests + broken.length };
}

/** @param {string} json Playwright's report; @returns {Count} */
function countPlaywright(json) {
	const { stats, errors } = JSON.parse(json);
	const { expected, flaky, unexpected } = stats;
	return { passed: expected + flaky, failed: unexpected + errors.length, again: flaky };
}

/**
 * Runs one runner and counts. A runner that dies without a report, fails without a failed test or runs no test is a failure.
 *
 * @param {string} name
 * @param {() => Promise<number>} start
 * @param {string} report file that it writes
 * @param {(text: string) => Count} count
 * @returns {Promise<Count>}
 */
async function tally(name, start, report, count) {
	console.log(`\n${name}`);
	/** @type {Count} */
	let result = { passed: 0, failed: 0 };
	let code = 1;
	try {
		code = await start();
		result = count(readFileSync(report, 'utf8'));
	} catch (error) {
		console.log(`${name}: ${/** @type {Error} */ (error).message}`);
	}
	if (result.failed === 0 && (code !== 0 || result.passed === 0)) {
		console.log(`${name}: exit code ${code}, ${result.passed} tests passed: counted as one failure`);
		result.failed = 1;
	}
	return result;
}

await command(async () => {
	const { values } = parseArgs({ options: { all: { type: 'boolean', default: false } } });
	if (values.all) process.env.FURBAKE_TEST_ALL = '1';
	await ensureNode();
	const reports = mkdtempSync(join(tmpdir(), 'furbake-test-'));
	const report = (/** @type {string} */ name) => join(reports, name);
	const module = (/** @type {string[]} */ ...path) => join(root, 'node_modules', ...path);

	const counts = [
		await tally(
			'pytest',
			async () => {
				await ensurePython({ dev: true });
				// On every core: each test uses one.
				const split = ['-n', 'auto', '--dist=worksteal'];
				const folder = join('..', 'tests', 'baker');
				const args = ['-c', 'pyproject.toml', ...split, `--junitxml=${report('pytest.xml')}`, folder];
				return run(python, ['-m', 'pytest', ...args], { cwd: join(root, 'baker') });
			},
			report('pytest.xml'),
			countJunit,
		),
		await tally(
			'vitest',
			() => {
				const reporters = ['--reporter=default', '--reporter=json', `--outputFile.json=${report('vitest.json')}`];
				const args = ['run', '--config', join('web', 'vitest.config.ts'), ...reporters];
				return run(process.execPath, [module('vitest', 'vitest.mjs'), ...args]);
			},
			report('vitest.json'),
			countVitest,
		),
		await tally(
			'playwright',
			async () => {
				const env = {
					...process.env,
					FURBAKE_CHROMIUM: await ensureBrowser(),
					PLAYWRIGHT_JSON_OUTPUT_FILE: report('playwright.json'),
				};
				const args = ['test', '--config', join('tests', 'browser', 'playwright.config.ts'), '--reporter=list,json'];
				return run(process.execPath, [module('@playwright', 'test', 'cli.js'), ...args], { env });
			},
			report('playwright.json'),
			countPlaywright,
		),
	];
	rmSync(reports, { recursive: true, force: true });

	const passed = counts.reduce((sum, count) => sum + count.passed, 0);
	const failed = counts.reduce((sum, count) => sum + count.failed, 0);
	const again = counts.reduce((sum, count) => sum + (count.again ?? 0), 0);
	console.log(`\n${passed} passed${again ? ` (${again} at the second try)` : ''}, ${failed} failed`);
	return failed === 0 ? 0 : 1;
});
