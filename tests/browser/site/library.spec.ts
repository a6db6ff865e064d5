import { execFile } from 'node:child_process';
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { promisify } from 'node:util';
import { gzipSync } from 'node:zlib';
import { build, type Rolldown } from 'vite';
import { root } from '../../../web/tools/process.mjs';
import { difference, expect, type Picture, picture, test } from '../harness.ts';
import { type Host, serveFolder } from '../host.ts';
import { drawInTurn } from '../inPage/gpu.ts';
import { licencesIn } from './licences.ts';

const run = promisify(execFile);
const npm = (...args: string[]) =>
	process.env.npm_execpath
		? run(process.execPath, [process.env.npm_execpath, ...args], { cwd: root })
		: run('npm', args, { cwd: root, shell: process.platform === 'win32' });

/**
 * Bytes of the loader in an app, minified, each file through gzip: of the app itself, and of all files that are there once a
 * model is shown, without and with its fins, with joints besides, and with the checks of a model.
 */
const BYTES = { app: 4.5e3, still: 44.7e3, fins: 50.6e3, character: 53.7e3, checked: 65.9e3 };

/** Bytes of `<fur-view>` with three.js inside, through gzip. */
const VIEW = 269e3;

/** A folder of someone else's, in which the package is installed as it would be from a registry. */
let app = '';
let packed: string[] = [];
let host: Host;

test.use({ viewport: { width: 240, height: 180 } });

test.beforeAll(async () => {
	app = mkdtempSync(join(tmpdir(), 'furbake-app-'));
	const { stdout } = await npm('pack', '--json', '--pack-destination', app);
	const [{ filename, files }] = JSON.parse(stdout);
	packed = files.map(({ path }: { path: string }) => path);
	writeFileSync(join(app, 'package.json'), '{ "private": true, "type": "module" }');
	await npm(
		'install',
		'--prefix',
		app,
		'--offline',
		'--legacy-peer-deps',
		'--no-audit',
		'--no-fund',
		join(app, filename),
	);
	mkdirSync(join(app, 'node_modules', '@types'));
	for (const name of ['three', join('@types', 'three')])
		symlinkSync(join(root, 'node_modules', name), join(app, 'node_modules', name), 'junction');
	cpSync(join(root, 'web', 'example'), join(app, 'example'), { recursive: true });
	cpSync(join(root, 'web', 'example.html'), join(app, 'index.html'));
});

test.afterAll(() => {
	host?.close();
	rmSync(app, { recursive: true, force: true });
});

test('the package holds the library, its types and its licences, and nothing else', () => {
	expect(packed).toEqual(
		expect.arrayContaining([
			'LICENSE',
			'README.md',
			'package.json',
			'lib/index.js',
			'lib/index.d.ts',
			'lib/reference.js',
			'lib/reference.d.ts',
			...['checks', 'growFur', 'fins', 'pose', 'regions', 'horizon', 'environmentMap'].map((name) => `lib/${name}.js`),
			'lib/licenses.md',
			'lib/fur-view.js',
			'lib/fur-view.licenses.md',
		]),
	);
	const others = packed.filter((path) => !/^lib\/(.*\.d\.ts|shared\d*\.js)$/.test(path));
	expect(others).toHaveLength(16);
	const parts = licencesIn(readFileSync(join(app, 'node_modules', 'furbake', 'lib', 'licenses.md'), 'utf8'));
	expect([...parts.keys()]).toEqual(['@cfworker/json-schema']);
	for (const [name, text] of parts) expect(text, name).toContain('Permission is hereby granted');
});

/** Uses of both entry points in another app. */
const USES = `
import { dressFur, type Fur, FurMotion, FurWeather, furMethod, updateFurs } from 'furbake';
import { type Basis, lightMoments } from 'furbake/reference';
import { FurView } from 'furbake/view';

export function grow(fur: Fur, pelt: Fur): () => boolean {
	const other = dressFur(fur, pelt);
	other.motion = new FurMotion(fur, { frequency: 3 });
	other.weather = new FurWeather(fur, { drying: 20 });
	furMethod(fur, 'lengyel').apply();
	fur.length = 0.5 * fur.asset.length;
	return () => fur.update(0.1) || updateFurs([fur, other], 0);
}

export function follow(): void {
	const view = document.querySelector('fur-view');
	view?.addEventListener('lightchange', ({ detail }) => {
		view.light = detail.light;
	});
	view?.addEventListener('error', ({ message }) => message.trim());
	const made: FurView = new FurView();
	made.camera = '0,8,1';
}

const basis: Basis = { kind: 'ptm' };
export const moments: number[] = lightMoments(basis, [0.6, 0, 0.8], 0.5);
`;

test('an app that loads fur and no more has few bytes of the library', async () => {
	const entry = join(app, 'loader.js');
	writeFileSync(entry, "export { FurLoaderPlugin } from 'furbake';");
	const built = (await build({
		root: app,
		configFile: false,
		logLevel: 'error',
		build: {
			write: false,
			modulePreload: false,
			rolldownOptions: { input: entry, preserveEntrySignatures: 'strict', external: /^three(\/|$)/ },
		},
	})) as Rolldown.RolldownOutput;
	const chunks = built.output.filter((file) => file.type === 'chunk');
	/** Bytes of the app with these files, and what they import. */
	const bytesWith = (...names: string[]) => {
		const there = new Set<string>();
		const add = (fileName: string) => {
			if (there.has(fileName)) return;
			there.add(fileName);
			for (const other of chunks.find((chunk) => chunk.fileName === fileName)?.imports ?? []) add(other);
		};
		for (const { fileName, name, isEntry } of chunks) if (isEntry || names.includes(name)) add(fileName);
		return chunks.reduce((sum, { fileName, code }) => sum + (there.has(fileName) ? gzipSync(code).length : 0), 0);
	};
	const bytes = {
		app: bytesWith(),
		still: bytesWith('growFur'),
		fins: bytesWith('growFur', 'fins'),
		character: bytesWith('growFur', 'fins', 'pose'),
		checked: bytesWith('growFur', 'fins', 'pose', 'checks'),
	};
	const kilobytes = Object.entries(bytes).map(([name, sum]) => `${name} ${(sum / 1e3).toFixed(1)}`);
	process.stdout.write(`     FurLoaderPlugin, kB: ${kilobytes.join(', ')}\n`);
	for (const [name, most] of Object.entries(BYTES)) expect(bytes[name as keyof typeof bytes], name).toBeLessThan(most);
	const code = chunks.map((chunk) => chunk.code);
	// Shaders come without their comments.
	expect(/\/\/ \w/.test(code.join(''))).toBe(false);
});

test('the tag is one light file with its licences, imports nothing, and is nothing to Node', async () => {
	const lib = join(app, 'node_modules', 'furbake', 'lib');
	const code = readFileSync(join(lib, 'fur-view.js'), 'utf8');
	const bytes = gzipSync(code).length;
	process.stdout.write(`     fur-view.js: ${(bytes / 1e3).toFixed(1)} kB\n`);
	expect(bytes).toBeLessThan(VIEW);
	expect(/\bimport\(/.test(code), 'fetches further modules').toBe(false);
	expect(code.includes('WebAssembly.instantiate'), 'needs WebAssembly').toBe(false);
	const parts = licencesIn(readFileSync(join(lib, 'fur-view.licenses.md'), 'utf8'));
	expect([...parts.keys()]).toEqual(expect.arrayContaining(['@cfworker/json-schema', 'meshoptimizer', 'three']));
	const alone = mkdtempSync(join(tmpdir(), 'furbake-alone-'));
	cpSync(join(lib, 'fur-view.js'), join(alone, 'fur-view.mjs'));
	const say = "import { FurView } from './fur-view.mjs'; console.log(typeof FurView)";
	const { stdout } = await run(process.execPath, ['--input-type=module', '-e', say], { cwd: alone });
	rmSync(alone, { recursive: true });
	expect(stdout.trim()).toBe('function');
});

test('example and uses compile strictly against the packed types', async () => {
	writeFileSync(join(app, 'example', 'uses.ts'), USES);
	const compilerOptions = {
		target: 'es2023',
		lib: ['es2023', 'dom'],
		module: 'nodenext',
		strict: true,
		exactOptionalPropertyTypes: true,
		noEmit: true,
		skipLibCheck: false,
		types: [],
	};
	writeFileSync(join(app, 'tsconfig.json'), JSON.stringify({ compilerOptions, include: ['example'] }));
	const tsc = join(root, 'node_modules', '@typescript', 'native', 'bin', 'tsc');
	const { stdout } = await run(process.execPath, [tsc, '-p', app]).catch((error) => error);
	expect(stdout).toBe('');
});

test('the arithmetic on the CPU is an entry point of its own, which Node runs', async () => {
	const code = `import { lightMoments } from 'furbake/reference';
		console.log(JSON.stringify(lightMoments({ kind: 'ptm' }, [0.6, 0, 0.8], 0.5)))`;
	const { stdout } = await run(process.execPath, ['--input-type=module', '-e', code], { cwd: app });
	expect(JSON.parse(stdout)).toEqual([0.36, 0, 0, 0.6, 0, 1]);
});

test('the example, built by another app, grows fur under the pointer as lamp', async ({ page }) => {
	await build({
		root: app,
		base: './',
		configFile: false,
		logLevel: 'error',
		publicDir: join(root, 'public'),
		build: { modulePreload: { polyfill: false }, chunkSizeWarningLimit: 1200 },
	});
	host = await serveFolder(join(app, 'dist'), '/');
	await drawInTurn(page);
	/** The picture once the model is in it. */
	const shown = async () => {
		await page.goto(host.address);
		await page.locator('canvas').waitFor();
		await page.mouse.move(20, 40);
		await expect.poll(async () => covered(await picture(page))).toBeGreaterThan(0.1);
		return picture(page);
	};
	const furry = await shown();
	await page.mouse.move(220, 40);
	await expect.poll(async () => difference(furry, await picture(page))).toBeGreaterThan(2);

	await page.route('**/model.gltf', async (route) => {
		const { extensions: _, ...plain } = await (await route.fetch()).json();
		await route.fulfill({ json: plain });
	});
	expect(difference(furry, await shown()), 'from the skin alone').toBeGreaterThan(3.5);
});

/** Share of the picture that is not its ground. */
function covered({ brightness }: Picture): number {
	const ground = brightness[0] ?? 0;
	return brightness.filter((value) => Math.abs(value - ground) > 8).length / brightness.length;
}
