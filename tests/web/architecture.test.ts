/** The floors of the web wing: imports only go down, the library knows no page, pages know no shader. */

import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, relative, sep } from 'node:path';
import { fileURLToPath } from 'node:url';
import { createSourceFile, forEachChild, isFunctionLike, type Node, ScriptTarget } from 'typescript';
import { describe, expect, it } from 'vitest';

const web = fileURLToPath(new URL('../../web/', import.meta.url));

/** Rooms and files of the library from the ground up; those of one floor do not import each other. */
const floors = [
	['format', 'needFur'],
	['light', 'body', 'fins'],
	['planes'],
	['weather', 'motion'],
	['shells'],
	['baselines', 'updateFurs', 'checks'],
	['Fur'],
	['load'],
	['dressFur', 'FurLoaderPlugin', 'picture', 'herd'],
	['index', 'reference'],
];
/** Files of code in one folder. */
const MAX_FILES = 15;
/** Lines of a function; a longer one has a comment in front of it, `Long: ` and the reason. */
const MAX_LINES = 60;
/** Rooms of the demo from the ground up; those of one floor do not import each other. Files of a room may, in no circle. */
const rooms = [['words'], ['state'], ['say'], ['open', 'stage'], ['rti'], ['model'], ['hands'], ['panel']];
const pages = ['demo', 'learn', 'bench', 'embed'];
/** What pages share, and what knows none of them. */
const shared = ['page', 'scene', 'view', 'measure'];

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

/** Room of a module of the library, or its own name at the root. */
const roomOf = (path: string) => path.replace(/^fur\/|\.ts$/g, '').split('/')[0] ?? '';
const floorOf = (path: string) => floors.findIndex((names) => names.includes(roomOf(path)));
const libraryImports = (path: string) =>
	imports(path).filter((other) => other.startsWith('fur/') && other.endsWith('.ts'));

/** Functions that are too long without a reason, or that give one without need. */
function misjudged(path: string): string[] {
	const source = text(path);
	const file = createSourceFile(path, source, ScriptTarget.Latest);
	const lineAt = (position: number) => file.getLineAndCharacterOfPosition(position).line + 1;
	const found: string[] = [];
	const visit = (node: Node) => {
		if (isFunctionLike(node) && 'body' in node && node.body) {
			const start = node.getStart(file);
			const lines = lineAt(node.end) - lineAt(start) + 1;
			const reason = /^\s*(\/\/|\/?\*+) Long: \S/m.test(source.slice(node.pos, start));
			if (reason !== lines > MAX_LINES) found.push(`${path}:${lineAt(start)}: ${lines} lines`);
		}
		forEachChild(node, visit);
	};
	visit(file);
	return found;
}

it.each(files.filter((path) => /\.(ts|mjs)$/.test(path) && text(path).split('\n').length > MAX_LINES))(
	'%s has no function of more than sixty lines, but those that say why',
	(path) => {
		expect(misjudged(path)).toEqual([]);
	},
);

it('no imports go in a circle', () => {
	const done = new Set<string>();
	const visit = (path: string, way: string[]) => {
		expect(way, 'a circle').not.toContain(path);
		if (done.has(path)) return;
		for (const name of imports(path).filter((other) => files.includes(other))) visit(name, [...way, path]);
		done.add(path);
	};
	for (const path of files.filter((path) => path.endsWith('.ts'))) visit(path, []);
});

it('no folder of code holds more than fifteen files', () => {
	const code = files.filter((path) => /\.(ts|glsl|mjs)$/.test(path) && !path.endsWith('.d.ts'));
	const counts = new Map<string, number>();
	for (const path of code) counts.set(dirname(path), (counts.get(dirname(path)) ?? 0) + 1);
	const crowded = [...counts].filter(([, count]) => count > MAX_FILES);
	expect(crowded).toEqual([]);
});

describe('the library web/fur', () => {
	const modules = below('fur');

	it.each(modules)('%s stands on a floor and imports only what is below it or in its room', (path) => {
		expect(floorOf(path), 'its floor').toBeGreaterThanOrEqual(0);
		for (const name of libraryImports(path)) {
			if (roomOf(name) !== roomOf(path)) expect(floorOf(name), name).toBeLessThan(floorOf(path));
		}
	});

	it.each(below('fur'))('%s takes nothing but packages, its own room and the schema', (path) => {
		for (const name of imports(path)) {
			const own = name.startsWith('fur/') || name === '../baker/furbake/asset/schema/FUR_ptm_shells.schema.json';
			const bare = /^(three(\/addons\/.*)?|@cfworker\/json-schema)$/.test(name);
			expect(own || bare, name).toBe(true);
		}
	});

	it.each(below('fur'))('%s never touches the page around it', (path) => {
		expect(text(path)).not.toMatch(/\b(document|window|location|localStorage)\s*[.[]/);
		expect(text(path)).not.toMatch(/\bconsole\.(log|info|debug|error)\b/);
	});

	it('reads the format without three', () => {
		for (const path of files.filter((path) => path.startsWith('fur/format') && path.endsWith('.ts')))
			expect(imports(path).filter((name) => name.startsWith('three'))).toEqual([]);
	});
});

describe('the demo web/demo', () => {
	const modules = below('demo');
	const roomOf = (path: string) => path.split('/')[1] ?? '';
	const roomFloor = (path: string) => rooms.findIndex((names) => names.includes(roomOf(path)));
	const own = (path: string) => imports(path).filter((name) => name.startsWith('demo/') && name.endsWith('.ts'));

	it('has its page in front, and everything else in a room of at most 15 files', () => {
		expect(modules.filter((path) => roomFloor(path) < 0)).toEqual(['demo/main.ts']);
		const sizes = rooms.flat().map((room) => files.filter((path) => path.startsWith(`demo/${room}/`)).length);
		expect(Math.min(...sizes)).toBeGreaterThan(0);
		expect(Math.max(...sizes)).toBeLessThanOrEqual(15);
	});

	it.each(modules.filter((path) => path !== 'demo/main.ts'))('%s imports its own room and those below', (path) => {
		for (const name of own(path).filter((other) => roomOf(other) !== roomOf(path)))
			expect(roomFloor(name), name).toBeLessThan(roomFloor(path));
		for (const name of own(path)) expect(roomFloor(name), name).toBeGreaterThanOrEqual(0);
	});

	it('has a view that imports nothing, which the store alone writes', () => {
		expect(imports('demo/state/view.ts')).toEqual([]);
		expect(modules.filter((path) => /new Store\(/.test(text(path)))).toEqual(['demo/main.ts']);
	});

	it.each(modules)('%s has at most 300 lines', (path) => {
		expect(text(path).split('\n').length - 1).toBeLessThanOrEqual(300);
	});
});

describe('the pages', () => {
	const modules = [...pages, ...shared].flatMap(below);

	it.each(modules)('%s takes the library by its entry points', (path) => {
		// The checks come beside a model's file, not after it.
		const entries = ['fur/index.ts', 'fur/reference.ts', ...(path === 'scene/load.ts' ? ['fur/checks.ts'] : [])];
		for (const name of imports(path).filter((other) => other.startsWith('fur/'))) expect(entries).toContain(name);
	});

	it.each(modules)('%s imports no other page', (path) => {
		const others = pages.filter((page) => !path.startsWith(`${page}/`));
		for (const name of imports(path)) expect(others).not.toContain(name.split('/')[0]);
	});

	it.each(below('measure'))(
		'%s measures for any page: it takes packages, its own room, what any page may have, and the library',
		(path) => {
			for (const name of imports(path))
				expect(name).toMatch(/^(three(\/addons\/.*)?$|(measure|page)\/|fur\/(index|reference)\.ts$)/);
		},
	);

	it.each(below('rti'))(
		'%s relights pictures for any page: it takes its own room, what any page may have, three',
		(path) => {
			for (const name of imports(path)) expect(name).toMatch(/^(rti\/|page\/|three$)/);
		},
	);

	it.each(below('scene'))(
		'%s shows furry models on any page: it takes packages, its own room, `page/` and the library',
		(path) => {
			for (const name of imports(path))
				expect(name).toMatch(/^(three(\/addons\/.*)?$|@pmndrs\/|(scene|page)\/|fur\/(index|reference|checks)\.ts$)/);
		},
	);

	it.each(below('page'))('%s is what any page may have: it takes its own room and three', (path) => {
		for (const name of imports(path)) expect(name).toMatch(/^(page\/|three(\/addons\/.*)?$)/);
	});

	// Eyes are no fur: they add a mirrored sky to three's own material.
	const furless = modules.filter((path) => path !== 'scene/gleam.ts');

	it.each([...furless, ...files.filter((path) => /^\w+\.html$/.test(path))])('%s contains no GLSL', (path) => {
		expect(text(path)).not.toMatch(/gl_Position|gl_Frag|\.glsl|ShaderMaterial|onBeforeCompile|void\s+main\s*\(/);
	});
});
