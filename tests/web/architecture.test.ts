/** The floors of the web wing: imports only go down, the library knows no page, pages know no shader. */

import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, posix, relative, sep } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';

const web = fileURLToPath(new URL('../../web/', import.meta.url));

/** The library from the ground up; modules of one floor do not import each other. A new module gets its floor here. */
const floors = [
	['format', 'SmoothEdges', 'names', 'weld', 'switches', 'steps', 'chunks'],
	[
		'planes',
		'moments',
		'comb',
		'clip',
		'shadow',
		'environment',
		'lod',
		'bodies',
		'pieces',
		'places',
		'governor',
		'limits',
		'states',
		'trim',
	],
	['levels', 'TrimLight', 'curves', 'stains', 'bent', 'hue'],
	['multiple', 'eye'],
	['texels', 'SlabLight'],
	['PeltLight'],
	['PeltMaterial', 'follicles'],
	['FurMaterial', 'PeltStates', 'FurWeather', 'skin', 'curvature'],
	['FinMaterial', 'HullMaterial'],
	['shells', 'fins'],
	['Fur'],
	['FurLoaderPlugin', 'FurFade', 'prepare'],
	['RivalMaterial'],
	['UnlitMaterial', 'LengyelMaterial', 'DeepOpacityMaps'],
	['ShadowLayersMaterial'],
	['method'],
	['level'],
	['instances'],
	// The room of what moves.
	['spring', 'drive', 'options', 'Turn', 'TexelPass', 'Stopwatch'],
	['solver', 'roots', 'Wind', 'Carriage', 'Strokes'],
	['CpuSprings', 'GpuSprings'],
	['FurMotion'],
	['index'],
];
const pages = ['demo', 'learn', 'bench'];
/** What pages share, and what knows none of them. */
const shared = ['page', 'measure'];

const files = readdirSync(web, { recursive: true, encoding: 'utf8' }).map((path) => path.split(sep).join('/'));
const below = (folder: string) => files.filter((path) => path.startsWith(`${folder}/`) && path.endsWith('.ts'));
const text = (path: string) => readFileSync(join(web, path), 'utf8');

/** What a module imports: bare names as they are, files relative to web/. */
function imports(path: string): string[] {
	const found = text(path).matchAll(/(?:\bfrom|^\s*import|\bimport\()\s*['"]([^'"]+)['"]/gm);
	return [...found].map(([, name = '']) =>
		name.startsWith('.')
			? relative(web, join(web, dirname(path), name))
					.split(sep)
					.join('/')
			: name,
	);
}

const floorOf = (path: string) => floors.findIndex((names) => names.includes(posix.basename(path, '.ts')));

describe('the library web/fur', () => {
	const modules = below('fur');

	it.each(modules)('%s stands on a floor, and imports only what is below it', (path) => {
		expect(floorOf(path), 'its floor').toBeGreaterThanOrEqual(0);
		for (const name of imports(path).filter((other) => other.startsWith('fur/') && other.endsWith('.ts'))) {
			expect(floorOf(name), name).toBeLessThan(floorOf(path));
		}
	});

	it.each(below('fur'))('%s takes nothing but packages, its own room and the schema', (path) => {
		for (const name of imports(path)) {
			const own = name.startsWith('fur/') || name === '../baker/furbake/asset/schema/FUR_ptm_shells.schema.json';
			const bare = /^(three(\/addons\/.*)?|fast-png|@cfworker\/json-schema)$/.test(name);
			expect(own || bare, name).toBe(true);
		}
	});

	it.each(below('fur'))('%s never touches the page around it', (path) => {
		expect(text(path)).not.toMatch(/\b(document|window|location|localStorage)\s*[.[]/);
		expect(text(path)).not.toMatch(/\bconsole\.(log|info|debug|error)\b/);
	});

	it('reads the format without three', () => {
		expect(imports('fur/format.ts').filter((name) => name.startsWith('three'))).toEqual([]);
	});
});

describe('the pages', () => {
	const modules = [...pages, ...shared].flatMap(below);

	it.each(modules)('%s takes the library by its one face', (path) => {
		for (const name of imports(path).filter((other) => other.startsWith('fur/'))) expect(name).toBe('fur/index.ts');
	});

	it.each(modules)('%s imports no other page', (path) => {
		const others = pages.filter((page) => !path.startsWith(`${page}/`));
		for (const name of imports(path)) expect(others).not.toContain(name.split('/')[0]);
	});

	it.each(below('measure'))('%s measures for any page: it takes packages, its own room and the library', (path) => {
		for (const name of imports(path)) expect(name).toMatch(/^(three(\/addons\/.*)?$|measure\/|fur\/index\.ts$)/);
	});

	it.each(below('page'))('%s is what any page may have: it takes its own room and three', (path) => {
		for (const name of imports(path)) expect(name).toMatch(/^(page\/|three(\/addons\/.*)?$)/);
	});

	it.each([...modules, ...files.filter((path) => /^\w+\.html$/.test(path))])('%s contains no GLSL', (path) => {
		expect(text(path)).not.toMatch(/gl_Position|gl_Frag|\.glsl|ShaderMaterial|onBeforeCompile|void\s+main\s*\(/);
	});
});
