/**
 * Running of other programs, and messages to the terminal; shared by all commands.
 *
 * All messages go to standard error: standard output belongs to the program that a command wraps.
 */
import { spawn } from 'node:child_process';
import { fileURLToPath } from 'node:url';

/** The repository's root, without a trailing slash. */
export const root = fileURLToPath(new URL('../../', import.meta.url)).replace(/[\\/]$/, '');

export const windows = process.platform === 'win32';

/** Failure reported in one line, without a stack. */
export class Failure extends Error {}

/** @param {string} line one line for the person at the terminal */
export function say(line) {
	process.stderr.write(`furbake: ${line}\n`);
}

/**
 * Runs a program to its end. Never rejects: a program that cannot be started counts as exit code 127.
 *
 * @param {string} command
 * @param {string[]} args
 * @param {import('node:child_process').SpawnOptions} [options] the default shows both outputs as they are
 * @returns {Promise<number>} exit code; 128 + number of the signal that ended it
 */
export function run(command, args, options = {}) {
	return new Promise((resolve) => {
		const child = spawn(command, args, { cwd: root, stdio: 'inherit', ...options });
		// Passed on: the time limit of a CI may end this process alone.
		const end = () => child.kill('SIGTERM');
		process.on('SIGTERM', end);
		const ended = (/** @type {number} */ code) => {
			process.off('SIGTERM', end);
			resolve(code);
		};
		child.on('error', () => ended(127));
		child.on('exit', (code, signal) => ended(code ?? (signal === 'SIGINT' ? 130 : 143)));
	});
}

/**
 * Like `run`, for a helper whose chatter must not reach standard output.
 *
 * @param {string} command
 * @param {string[]} args
 * @param {import('node:child_process').SpawnOptions} [options]
 */
export function runAside(command, args, options = {}) {
	return run(command, args, { stdio: ['ignore', 2, 2], ...options });
}

/**
 * Standard output of a program; undefined if it is missing or fails.
 *
 * @param {string} command
 * @param {string[]} args
 * @param {{ shell?: boolean }} [options]
 * @returns {Promise<string | undefined>}
 */
export function ask(command, args, options = {}) {
	return new Promise((resolve) => {
		const child = spawn(command, args, { cwd: root, stdio: ['ignore', 'pipe', 'ignore'], ...options });
		let text = '';
		child.stdout.on('data', (chunk) => {
			text += chunk;
		});
		child.on('error', () => resolve(undefined));
		child.on('close', (code) => resolve(code === 0 ? text : undefined));
	});
}

/**
 * Runs a command's body: a `Failure` or a wrong option becomes its one line and exit code 1; a returned number is the exit code.
 *
 * @param {() => Promise<number | void>} body
 */
export async function command(body) {
	try {
		process.exitCode = (await body()) ?? 0;
	} catch (error) {
		const { code, message } = /** @type {NodeJS.ErrnoException} */ (error);
		if (!(error instanceof Failure || code?.startsWith('ERR_PARSE_ARGS'))) throw error;
		say(message);
		process.exitCode = 1;
	}
}
