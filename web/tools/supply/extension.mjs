/** Blender's extension as a zip: the add-on, with the version of package.json and the viewer that `npm run library` builds. */
import { existsSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { zipSync } from 'fflate';
import { Failure, root } from '../process.mjs';

const source = join(root, 'baker', 'blender');
const viewer = ['fur-view.js', 'fur-view.licenses.md'];
/** Time of every file in the zip, so that the same files give the same bytes: the earliest that the format has. */
const mtime = new Date(1980, 0, 1);

/** @param {string} file; @returns {Uint8Array} */
const bytes = (file) => new Uint8Array(readFileSync(file));

/**
 * Writes `furbake-blender-VERSION.zip`.
 *
 * @param {string} folder
 * @param {string} [built] folder of the built viewer
 * @returns {string} its path
 */
export function packExtension(folder, built = join(root, 'lib')) {
	const { version } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8'));
	/** @type {Record<string, Uint8Array>} */
	const files = { LICENSE: bytes(join(root, 'LICENSE')) };
	for (const name of readdirSync(source)) if (/\.(py|toml)$/.test(name)) files[name] = bytes(join(source, name));
	for (const name of readdirSync(join(source, 'page'))) files[`page/${name}`] = bytes(join(source, 'page', name));
	for (const name of viewer) {
		const file = join(built, name);
		if (!existsSync(file)) throw new Failure(`${file}: no such file, expected it of npm run library`);
		files[`page/${name}`] = bytes(file);
	}
	const manifest = new TextDecoder().decode(files['blender_manifest.toml']);
	const stamped = manifest.replace(/^version = .*$/m, `version = "${version}"`);
	if (stamped === manifest) throw new Failure('blender_manifest.toml: no version, expected a line for it');
	files['blender_manifest.toml'] = new TextEncoder().encode(stamped);
	const out = join(folder, `furbake-blender-${version}.zip`);
	writeFileSync(out, zipSync(files, { mtime, level: 9 }));
	return out;
}
