/** Any browser as a plain child process with a profile of its own: for measurements that no driver may disturb. */
import { spawn } from 'node:child_process';
import { accessSync, constants, existsSync, mkdtempSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, delimiter, join } from 'node:path';
import { browserArgs } from './browser.mjs';
import { Failure, windows } from './process.mjs';

/** Names of programs by the name of their kind. */
const PROGRAMS = {
	firefox: ['firefox', 'firefox-esr'],
	chromium: ['chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable'],
};

/** WebGL2 on software, clocks as fine as they come, no word to anybody. */
const FIREFOX_PREFERENCES = {
	'webgl.force-enabled': true,
	'webgl.disable-fail-if-major-performance-caveat': true,
	'privacy.reduceTimerPrecision': false,
	'privacy.resistFingerprinting': false,
	'dom.max_script_run_time': 0,
	'dom.min_background_timeout_value': 0,
	'browser.shell.checkDefaultBrowser': false,
	'browser.aboutwelcome.enabled': false,
	'browser.startup.homepage_override.mstone': 'ignore',
	'app.update.enabled': false,
	'datareporting.policy.dataSubmissionEnabled': false,
	'toolkit.telemetry.enabled': false,
	'network.captive-portal-service.enabled': false,
	'network.connectivity-service.enabled': false,
};

/** Chromium's switches that have it draw on the processor. */
const SOFTWARE = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

/** @param {string} name; @returns {string | undefined} where it lies on the PATH */
function onPath(name) {
	const folders = (process.env.PATH ?? '').split(delimiter).filter(Boolean);
	return folders.map((folder) => join(folder, windows ? `${name}.exe` : name)).find(startable);
}

/** @param {string} path */
function startable(path) {
	try {
		accessSync(path, constants.X_OK);
		return statSync(path).isFile();
	} catch {
		return false;
	}
}

/**
 * @param {string} wanted `firefox`, `chromium`, another program's name, or a path
 * @returns {string} path of the program
 */
export function findProgram(wanted) {
	const names = wanted === 'firefox' || wanted === 'chromium' ? PROGRAMS[wanted] : [wanted];
	const found = /[\\/]/.test(wanted) ? [wanted].find(startable) : names.map(onPath).find(Boolean);
	if (!found) throw new Failure(`--browser: got ${wanted}, expected firefox, chromium or the path of a browser`);
	return found;
}

/**
 * Starts a browser on a page.
 *
 * @param {string} program
 * @param {string} url
 * @param {{ gpu?: boolean }} [options] whether Chromium may use the graphics card
 * @returns {{ ended: Promise<string>, close: () => Promise<void> }} what it said when it has ended by itself, and what ends
 * it and removes its profile
 */
export function launch(program, url, { gpu = false } = {}) {
	const profile = mkdtempSync(join(tmpdir(), 'furbake-browser-'));
	const firefox = /firefox|librewolf|waterfox/i.test(basename(program));
	let [command, args] = [program, /** @type {string[]} */ ([])];
	if (firefox) {
		const lines = Object.entries(FIREFOX_PREFERENCES).map(
			([name, value]) => `user_pref(${JSON.stringify(name)}, ${JSON.stringify(value)});`,
		);
		writeFileSync(join(profile, 'user.js'), `${lines.join('\n')}\n`);
		args = ['--no-remote', '--profile', profile, url];
		// Its headless mode has no WebGL2: without a screen it gets one that nobody sees.
		const screen = process.env.DISPLAY || process.env.WAYLAND_DISPLAY;
		const xvfb = process.platform === 'linux' && !screen ? onPath('xvfb-run') : undefined;
		if (xvfb) [command, args] = [xvfb, ['-a', '-s', '-screen 0 1280x1024x24', program, ...args]];
	} else {
		const kept = browserArgs.filter((argument) => !gpu || !SOFTWARE.includes(argument));
		args = [...kept, `--user-data-dir=${profile}`, url];
	}
	// A group of its own: a browser is many processes, and all of them and no others are to end.
	const child = spawn(command, args, {
		detached: !windows,
		stdio: ['ignore', 'ignore', 'pipe'],
		env: { ...process.env, HOME: firefox ? profile : process.env.HOME, MOZ_CRASHREPORTER_DISABLE: '1' },
	});
	let words = '';
	child.stderr.on('data', (chunk) => {
		words = (words + chunk).slice(-2000);
	});
	let gone = false;
	/** @type {Promise<string>} */
	const ended = new Promise((resolve) => {
		child.on('error', (error) => {
			gone = true;
			resolve(error.message);
		});
		child.on('exit', (code, signal) => {
			gone = true;
			resolve(
				[`it ended with ${signal ?? `exit code ${code}`}`, words.trim().split('\n').at(-1)].filter(Boolean).join(': '),
			);
		});
	});

	/** @param {NodeJS.Signals} signal */
	function kill(signal) {
		try {
			if (windows || child.pid === undefined) child.kill(signal);
			else process.kill(-child.pid, signal);
		} catch {
			// Nobody is left in the group.
		}
	}

	return {
		ended,
		async close() {
			kill('SIGTERM');
			const patience = setTimeout(() => kill('SIGKILL'), 5000);
			if (!gone) await ended;
			clearTimeout(patience);
			kill('SIGKILL');
			if (existsSync(profile)) rmSync(profile, { recursive: true, force: true, maxRetries: 10, retryDelay: 200 });
		},
	};
}
