/** The browser of `npm run bench`: found or not, started, and gone with all that it started. */

import { spawnSync } from 'node:child_process';
import { chmodSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, afterEach, describe, expect, it, vi } from 'vitest';
import { findProgram, launch } from '../../../web/tools/measure/launch.mjs';

const folder = mkdtempSync(join(tmpdir(), 'furbake-launch-test-'));
afterAll(() => rmSync(folder, { recursive: true, force: true }));
afterEach(() => vi.unstubAllEnvs());

/** A program that tells its arguments and process ids and then does nothing, as does its child. */
function fakeBrowser(name: string, body: string): string {
	const path = join(folder, name);
	writeFileSync(path, `#!${process.execPath}\n${body}`);
	chmodSync(path, 0o755);
	return path;
}

async function until<T>(probe: () => T | undefined): Promise<T> {
	for (;;) {
		const found = probe();
		if (found !== undefined) return found;
		await new Promise((resolve) => setTimeout(resolve, 20));
	}
}

const alive = (pid: number) => {
	try {
		process.kill(pid, 0);
		return !/^State:\s+Z/m.test(readFileSync(`/proc/${pid}/status`, 'utf8'));
	} catch {
		return false;
	}
};

describe.skipIf(process.platform !== 'linux')('a browser', () => {
	it('gets the page and a profile of its own, and leaves nothing behind', async () => {
		const told = join(folder, 'told.json');
		const program = fakeBrowser(
			'some-browser',
			`const { spawn } = require('node:child_process');
			const child = spawn(process.execPath, ['-e', 'setInterval(() => {}, 1000)']);
			const text = JSON.stringify({ args: process.argv.slice(2), pids: [process.pid, child.pid] });
			require('node:fs').writeFileSync(${JSON.stringify(`${told}.part`)}, text);
			require('node:fs').renameSync(${JSON.stringify(`${told}.part`)}, ${JSON.stringify(told)});
			setInterval(() => {}, 1000);`,
		);
		const browser = launch(program, 'http://127.0.0.1:1/page');
		const { args, pids } = await until(() => (existsSync(told) ? JSON.parse(readFileSync(told, 'utf8')) : undefined));
		expect(args.at(-1)).toBe('http://127.0.0.1:1/page');
		const profile = args.find((arg: string) => arg.startsWith('--user-data-dir='))?.split('=')[1];
		expect(existsSync(profile)).toBe(true);
		expect(args).toContain('--use-angle=swiftshader');
		expect(pids.map(alive)).toEqual([true, true]);
		await browser.close();
		await until(() => (pids.some(alive) ? undefined : true));
		expect(existsSync(profile)).toBe(false);
	});

	it('that ends by itself says why', async () => {
		const program = fakeBrowser('sick-browser', `console.error('no screen'); process.exitCode = 3;`);
		const browser = launch(program, 'http://127.0.0.1:1/');
		expect(await browser.ended).toBe('it ended with exit code 3: no screen');
		await browser.close();
	});

	it('that is not there is named', () => {
		for (const wanted of ['no-such-browser', join(folder, 'nothing'), folder])
			expect(() => findProgram(wanted)).toThrow(
				`--browser: got ${wanted}, expected firefox, chromium or the path of a browser`,
			);
	});

	it('known by name and not installed says where it was looked for', () => {
		vi.stubEnv('PATH', folder);
		expect(() => findProgram('firefox')).toThrow(
			'--browser: firefox is not installed, or not on the PATH as firefox or firefox-esr',
		);
	});
});

describe('npm run bench', () => {
	it.each([
		[['--rounds', '0'], '--rounds: got 0, expected 1 to 99'],
		[['--size', 'big'], '--size: got big, expected width and height, 16 to 9999 pixels, as in 1280x720'],
		[['--parts', 'results,all'], '--parts: got results,all, expected some of results,layers,costs,curves,card'],
		[['--triangles', '512,513'], '--triangles: got 512,513, expected some of 512,4608,16896'],
		[['--browser', '/no/browser'], '--browser: got /no/browser, expected firefox, chromium or the path of a browser'],
		[['--json', '/no/folder/out.json'], '--json: /no/folder/out.json: expected a file in a folder that is there'],
		[
			['--baseline', '/no/before.json'],
			"--baseline: /no/before.json: ENOENT: no such file or directory, open '/no/before.json'",
		],
	])('%j is refused in one line before anything is measured', (args, words) => {
		const command = fileURLToPath(new URL('../../../web/tools/measure/bench.mjs', import.meta.url));
		const { status, stdout, stderr } = spawnSync(process.execPath, [command, ...args], { encoding: 'utf8' });
		expect(stderr).toBe(`furbake: ${words}\n`);
		expect(stdout).toBe('');
		expect(status).toBe(1);
	});
});
