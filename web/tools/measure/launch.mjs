/** Browsers as plain child processes with their own profile, for measurements without a driver. */
import { spawn } from 'node:child_process';
import { accessSync, constants, existsSync, mkdtempSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, delimiter, join } from 'node:path';
import { browserArgs } from '../browser.mjs';
import { Failure, windows } from '../process.mjs';

/** Names of programs by browser. */
const PROGRAMS = {
	firefox: ['firefox', 'firefox-esr'],
	chromium: ['chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable'],
};

/** WebGL2 in software, fine clocks, no telemetry. */
export const FIREFOX_PREFERENCES = {
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

/** Switches of Chromium for drawing on the processor. */
const SOFTWARE = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

/** @param {string} name; @returns {string | undefined} its path on the PATH */
function onPath(name) {
	const folders = (process.env.PATH ?? '').split(delimiter).filter(Boolean);
	return folders.map((folder) => join(folder, windows ? `${name}.exe` : name)).find(startable);
}

/** @param {'firefox' | 'chromium' | 'Xvfb'} name; @returns {string | undefined} path of the program where it is installed */
export function installed(name) {
	return (name === 'Xvfb' ? [name] : PROGRAMS[name]).map(onPath).find(Boolean);
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
	const known = wanted === 'firefox' || wanted === 'chromium';
	const names = known ? PROGRAMS[wanted] : [wanted];
	const found = /[\\/]/.test(wanted) ? [wanted].find(startable) : names.map(onPath).find(Boolean);
	if (!found && known)
		throw new Failure(`--browser: ${wanted} is not installed, or not on the PATH as ${names.join(' or ')}`);
	if (!found) throw new Failure(`--browser: got ${wanted}, expected firefox, chromium or the path of a browser`);
	return found;
}

/**
 * Firefox with its preferences in the profile.
 *
 * @param {string} program
 * @param {string} profile folder of the profile
 * @param {string} url
 * @returns {[command: string, args: string[]]}
 */
function firefoxCommand(program, profile, url) {
	const lines = Object.entries(FIREFOX_PREFERENCES).map(
		([name, value]) => `user_pref(${JSON.stringify(name)}, ${JSON.stringify(value)});`,
	);
	writeFileSync(join(profile, 'user.js'), `${lines.join('\n')}\n`);
	const args = ['--no-remote', '--profile', profile, url];
	// Headless Firefox has no WebGL2: without a screen it gets a virtual one.
	const screen = process.env.DISPLAY || process.env.WAYLAND_DISPLAY;
	const xvfb = process.platform === 'linux' && !screen ? onPath('xvfb-run') : undefined;
	return xvfb ? [xvfb, ['-a', '-s', '-screen 0 1280x1024x24', program, ...args]] : [program, args];
}

/**
 * Starts a browser on a page.
 *
 * @param {string} program
 * @param {string} url
 * @param {{ gpu?: boolean }} [options] whether Chromium may use the graphics card
 * @returns {{ ended: Promise<string>, close: () => Promise<void> }} its output if it ends by itself, and a function that
 * ends it and removes its profile
 */
export function launch(program, url, { gpu = false } = {}) {
	const profile = mkdtempSync(join(tmpdir(), 'furbake-browser-'));
	const firefox = /firefox|librewolf|waterfox/i.test(basename(program));
	const kept = browserArgs.filter((argument) => !gpu || !SOFTWARE.includes(argument));
	const [command, args] = firefox
		? firefoxCommand(program, profile, url)
		: [program, [...kept, `--user-data-dir=${profile}`, url]];
	// A process group, so that all processes of the browser and no others can be ended.
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
			// The group has already ended.
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
