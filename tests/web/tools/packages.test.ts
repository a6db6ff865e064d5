/** What would be published; `FURBAKE_TEST_ALL=1` builds it. */

import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, describe, expect, it } from 'vitest';
import { root } from '../../../web/tools/process.mjs';

const folder = mkdtempSync(join(tmpdir(), 'furbake-packages-'));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

describe('package.json', () => {
	const { version, publishConfig, ...others } = JSON.parse(readFileSync(join(root, 'package.json'), 'utf8'));

	it('can be published, by the workflow alone', () => {
		expect(others.private).toBeUndefined();
		expect(publishConfig).toEqual({ access: 'public', provenance: true });
	});

	it('has the version that the lock file has, and no other file of ours says one', () => {
		const lock = JSON.parse(readFileSync(join(root, 'package-lock.json'), 'utf8'));
		expect([lock.version, lock.packages[''].version]).toEqual([version, version]);
		expect(readFileSync(join(root, 'baker', 'pyproject.toml'), 'utf8')).not.toMatch(/^version = "/m);
	});
});

describe.skipIf(process.env.FURBAKE_TEST_ALL !== '1')('npm run packages', () => {
	it('builds what publint, attw and twine approve of, with its checksums', { timeout: 600_000 }, () => {
		const script = join(root, 'web', 'tools', 'supply', 'packages.mjs');
		execFileSync(process.execPath, [script, '--out', folder], { stdio: ['ignore', 'ignore', 'inherit'] });
		const sums = readFileSync(join(folder, 'SHA256SUMS'), 'utf8').trim().split('\n');
		const names = sums.map((line) => line.split('  ')[1] ?? '');
		expect(names.map((name) => name.replace(/^furbake-[\d.]+\d/, ''))).toEqual([
			'-py3-none-any.whl',
			'.tar.gz',
			'.tgz',
		]);
		for (const line of sums) {
			const [sum, name = ''] = line.split('  ');
			expect(
				createHash('sha256')
					.update(readFileSync(join(folder, name)))
					.digest('hex'),
			).toBe(sum);
		}
	});
});
