import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { validateBytes } from 'gltf-validator';
import { describe, expect, it } from 'vitest';

const root = fileURLToPath(new URL('../../../', import.meta.url));

/** Every glTF that furbake wrote and that is kept here. */
const assets = ['public/models', 'tests/golden'].flatMap((folder) =>
	existsSync(join(root, folder))
		? readdirSync(join(root, folder), { recursive: true, encoding: 'utf8' })
				.filter((path) => basename(path) === 'model.gltf')
				.map((path) => join(folder, path))
		: [],
);

describe('the Khronos validator', () => {
	it('has the default models to look at', () => {
		const models: { name: string }[] = JSON.parse(readFileSync(join(root, 'public/models/models.json'), 'utf8'));
		for (const { name } of models) expect(assets).toContain(join('public', 'models', name, 'model.gltf'));
	});

	it.each(assets)('finds no error in %s', async (path) => {
		const file = join(root, path);
		const report = await validateBytes(new Uint8Array(readFileSync(file)), {
			uri: basename(file),
			externalResourceFunction: async (uri) => new Uint8Array(readFileSync(join(dirname(file), uri))),
		});
		expect(report.issues.messages.filter(({ severity }) => severity === 0)).toEqual([]);
		expect(report.issues.numErrors).toBe(0);
	});
});
