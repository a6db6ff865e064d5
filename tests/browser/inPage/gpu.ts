/** Runs inside the page, before its own scripts: counts what is asked of the GPU, and takes away what a poorer one lacks. */

import type { Page } from '@playwright/test';

/** What `watchGpu` leaves in the page. */
export interface Gpu {
	/** Objects that were made and not deleted, by kind. */
	live(): Record<string, number>;
	/** Calls that bring data to textures or buffers, or make room for it, by name. */
	uploads: Record<string, number>;
	/** What was asked for as anisotropy of a texture. */
	anisotropy: number[];
	/** Answers of `getParameter` in place of the GPU's own, by the parameter's name. */
	parameters: Record<string, number>;
	/** Milliseconds that every timer query tells, by the width of the canvas; undefined: what it measured. */
	time: ((width: number) => number) | undefined;
	/** Fences that were set, and whether they stay as if nothing were drawn. */
	fences: number;
	behind: boolean;
}

declare global {
	interface Window {
		gpu: Gpu;
		/** Names of materials whose programs were used before they were ready, see `compileAside`. */
		unready: string[];
	}
}

/** @param missing names of extensions that this GPU is not to have */
export async function watchGpu(page: Page, missing: string[] = []): Promise<void> {
	await page.addInitScript((missing) => {
		type Call = (this: WebGL2RenderingContext, ...args: unknown[]) => unknown;
		const proto = WebGL2RenderingContext.prototype as unknown as Record<string, Call>;
		const kinds = 'Buffer Framebuffer Program Query Renderbuffer Sampler Shader Texture TransformFeedback VertexArray';
		const objects = new Map<string, Set<unknown>>();
		const gpu: Gpu = {
			live: () => Object.fromEntries([...objects].map(([kind, set]) => [kind, set.size])),
			uploads: {},
			anisotropy: [],
			parameters: {},
			time: undefined,
			fences: 0,
			behind: false,
		};
		window.gpu = gpu;
		const wrap = (
			name: string,
			around: (call: () => unknown, args: unknown[], gl: WebGL2RenderingContext) => unknown,
		) => {
			const own = proto[name] as Call;
			proto[name] = function (...args) {
				return around(() => own.apply(this, args), args, this);
			};
		};
		for (const kind of kinds.split(' ')) {
			const live = new Set<unknown>();
			objects.set(kind, live);
			wrap(`create${kind}`, (call) => {
				const object = call();
				if (object) live.add(object);
				return object;
			});
			wrap(`delete${kind}`, (call, [object]) => {
				live.delete(object);
				return call();
			});
		}
		for (const name of Object.getOwnPropertyNames(proto)) {
			if (!/^(compressed)?Tex(Sub)?Image|^tex(Sub)?Image|^texStorage|^copyTex|^bufferData|^bufferSubData/i.test(name))
				continue;
			wrap(name, (call) => {
				gpu.uploads[name] = (gpu.uploads[name] ?? 0) + 1;
				return call();
			});
		}
		wrap('texParameterf', (call, [, name, value]) => {
			if (name === 0x84fe) gpu.anisotropy.push(value as number);
			return call();
		});
		wrap('getExtension', (call, [name]) => (missing.includes(name as string) ? null : call()));
		wrap('getSupportedExtensions', (call) => (call() as string[] | null)?.filter((name) => !missing.includes(name)));
		wrap('getParameter', (call, [asked], gl) => {
			for (const [name, value] of Object.entries(gpu.parameters))
				if ((gl as unknown as Record<string, number>)[name] === asked) return value;
			return call();
		});
		wrap('fenceSync', (call) => {
			gpu.fences++;
			return call();
		});
		wrap('getSyncParameter', (call, _, gl) => (gpu.behind ? gl.UNSIGNALED : call()));
		wrap('getQueryParameter', (call, [, asked], gl) =>
			asked === gl.QUERY_RESULT && gpu.time ? gpu.time(gl.canvas.width) * 1e6 : call(),
		);
	}, missing);
}

/** Draws each frame to its end before the next begins: a page that does not wait itself queues dozens in software. */
export async function drawInTurn(page: Page): Promise<void> {
	await page.addInitScript(() => {
		const request = window.requestAnimationFrame.bind(window);
		window.requestAnimationFrame = (draw) =>
			request((time) => {
				draw(time);
				const gl = document.querySelector('canvas')?.getContext('webgl2');
				gl?.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
			});
	});
}

/** Everything is made and asked for but the pixels: for what elements, objects or memory tell, not the picture. */
export async function drawNothing(page: Page): Promise<void> {
	await page.addInitScript(() => {
		const proto = WebGL2RenderingContext.prototype as unknown as Record<string, () => void>;
		for (const how of ['Arrays', 'Elements', 'RangeElements', 'ArraysInstanced', 'ElementsInstanced'])
			proto[`draw${how}`] = () => {};
	});
}

/**
 * @param width of the picture in CSS pixels, until it is restyled; the page around it keeps its own size
 * @param place of its left upper corner in the window; without one it stays where it is
 * @param hidden selectors of what lies over it and is not to be seen
 */
export async function shrinkPicture(
	page: Page,
	width: number,
	height: number,
	place?: readonly [left: number, top: number],
	hidden?: string,
): Promise<void> {
	const [left, top] = place ?? [];
	const covers = hidden ? `${hidden} { opacity: 0 !important }` : '';
	const fixed = place ? `position: fixed; left: ${left}px; top: ${top}px;` : '';
	await page.addInitScript((css) => {
		// As a sheet that is adopted: the site's policy lets no style element in.
		const sheet = new CSSStyleSheet();
		sheet.replaceSync(css);
		document.adoptedStyleSheets = [sheet];
	}, `#picture { ${fixed} width: ${width}px !important; height: ${height}px !important } ${covers}`);
}

/** Has programs compiled aside, as graphics cards do: each is ready a while after it was linked. */
export async function compileAside(page: Page): Promise<void> {
	await page.addInitScript(() => {
		const proto = WebGL2RenderingContext.prototype;
		const { shaderSource, attachShader, linkProgram, getProgramParameter, getExtension, useProgram } = proto;
		const [READY, WHILE] = [0x91b1, 100];
		const names = new WeakMap<object, string>();
		const linked = new WeakMap<WebGLProgram, number>();
		const isReady = (program: WebGLProgram) => performance.now() - (linked.get(program) ?? 0) > WHILE;
		window.unready = [];
		Object.assign(proto, {
			getExtension(this: WebGL2RenderingContext, name: string) {
				if (name === 'KHR_parallel_shader_compile') return { COMPLETION_STATUS_KHR: READY };
				return Reflect.apply(getExtension, this, [name]);
			},
			shaderSource(this: WebGL2RenderingContext, shader: WebGLShader, text: string) {
				names.set(shader, /#define SHADER_NAME (\w+)/.exec(text)?.[1] ?? '');
				shaderSource.call(this, shader, text);
			},
			attachShader(this: WebGL2RenderingContext, program: WebGLProgram, shader: WebGLShader) {
				names.set(program, names.get(shader) ?? '');
				attachShader.call(this, program, shader);
			},
			linkProgram(this: WebGL2RenderingContext, program: WebGLProgram) {
				linked.set(program, performance.now());
				linkProgram.call(this, program);
			},
			getProgramParameter(this: WebGL2RenderingContext, program: WebGLProgram, name: number) {
				return name === READY ? isReady(program) : getProgramParameter.call(this, program, name);
			},
			useProgram(this: WebGL2RenderingContext, program: WebGLProgram | null) {
				if (program && !isReady(program)) window.unready.push(names.get(program) ?? '');
				useProgram.call(this, program);
			},
		});
	});
}

/** Those of these names whose programs were used before they were ready. */
export const unready = (page: Page, names: RegExp): Promise<string[]> =>
	page.evaluate((those) => window.unready.filter((name) => new RegExp(those).test(name)), names.source);
