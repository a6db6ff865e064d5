/** Runs inside the page: going over from coarse planes to fine ones, and outlines. Its answers go to `planes.spec.ts`. */

import {
	BoxGeometry,
	Color,
	DirectionalLight,
	HalfFloatType,
	HemisphereLight,
	LinearToneMapping,
	Mesh,
	MeshBasicMaterial,
	OrthographicCamera,
	PerspectiveCamera,
	Scene,
	WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import { dressFur, FurEdgeEffect, FurFade, prepareFur } from '../../../web/fur/index.ts';
import { loadFur } from '../../../web/measure/studio.ts';

const SIZE = 96;

function drawer(size = SIZE) {
	const renderer = new WebGLRenderer({ outputBufferType: HalfFloatType });
	renderer.setSize(size, size, false);
	renderer.toneMapping = LinearToneMapping;
	const gl = renderer.getContext() as WebGL2RenderingContext;
	const read = () => {
		const pixels = new Uint8Array(4 * size * size);
		gl.readPixels(0, 0, size, size, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
		return pixels;
	};
	return { renderer, gl, read };
}

/** Mean and largest difference of two pictures, 0..255. */
function apart(a: Uint8Array, b: Uint8Array): { mean: number; most: number } {
	let [sum, most] = [0, 0];
	a.forEach((value, i) => {
		const difference = Math.abs(value - (b[i] ?? 0));
		sum += difference;
		most = Math.max(most, difference);
	});
	return { mean: sum / a.length, most };
}

/** From a body's own fur to another pelt in `steps` frames. */
export async function fade(body: string, pelt: string, steps: number) {
	const [own, other] = await Promise.all([body, pelt].map((url) => loadFur(url)));
	if (!own || !other) throw new Error('nothing to wear');
	const { renderer, gl, read } = drawer();
	const scene = new Scene();
	scene.background = new Color(0x334455);
	const lamp = new DirectionalLight(0xffffff, 6);
	lamp.position.set(-1, 0.6, 0.6);
	scene.add(lamp, lamp.target, new HemisphereLight(0xffffff, 0x808080, 2), own.skin.parent ?? own.skin);
	const camera = new PerspectiveCamera(20, 1, 0.1, 100);
	camera.position.set(0, 1, 8);
	camera.lookAt(0, 0, 0);
	own.shells.shellCount = 8;
	const draw = () => {
		renderer.render(scene, camera);
		return read();
	};
	const from = draw();

	const fine = dressFur(own, other);
	fine.shells.shellCount = 8;
	fine.visible = false;
	const linear = new WebGLRenderTarget(1, 1, { type: HalfFloatType });
	await prepareFur(fine, renderer, scene, camera, linear);
	linear.dispose();
	const programs = renderer.info.programs?.length ?? 0;
	const textures = renderer.info.memory.textures;
	fine.visible = true;
	const turning = new FurFade([own], [fine]);
	scene.add(turning);
	const frames: Uint8Array[] = [from];
	for (let i = 0; i <= steps; i++) {
		turning.share = i / steps;
		frames.push(draw());
	}
	turning.dispose();
	own.visible = false;
	const to = draw();
	frames.push(to);
	return {
		whole: apart(from, to),
		first: apart(from, frames[1] as Uint8Array),
		last: apart(frames.at(-2) as Uint8Array, to),
		worst: Math.max(...frames.slice(1).map((frame, i) => apart(frames[i] as Uint8Array, frame).mean)),
		// The quad's own program and target come with the fade.
		programs: (renderer.info.programs?.length ?? 0) - programs,
		textures: renderer.info.memory.textures - textures,
		parts: [own.shells.visible, fine.shells.visible],
		left: scene.children.includes(turning),
		error: gl.getError(),
	};
}

/** A turned square over stripes, drawn plainly, with smooth edges, and many times finer: how far off both are, 0..1. */
export function outline(marked: boolean) {
	const scene = new Scene();
	const stripes = new MeshBasicMaterial({ color: 0xccbbaa });
	const dark = new MeshBasicMaterial({ color: 0x887766 });
	const square = new MeshBasicMaterial({ color: 0x221100 });
	const add = (width: number, height: number, x: number, z: number, material: MeshBasicMaterial) => {
		const mesh = new Mesh(new BoxGeometry(width, height, 0.01), material);
		mesh.position.set(x, 0, z);
		scene.add(mesh);
		return mesh;
	};
	add(2, 2, 0, -1, stripes);
	// Whole pixels wide.
	for (let i = 0; marked && i < 16; i++) add(1 / 16, 2, (i - 7.75) / 8, -0.5, dark);
	add(1, 1, 0, 0, square).rotation.z = 0.3;
	const camera = new OrthographicCamera(-1, 1, 1, -1, 0.1, 10);
	camera.position.z = 2;
	const draw = (size: number, edges?: FurEdgeEffect) => {
		const { renderer, read } = drawer(size);
		renderer.setEffects(edges ? [edges] : []);
		renderer.render(scene, camera);
		const pixels = read();
		renderer.dispose();
		return pixels;
	};
	const plain = draw(64);
	const fine = draw(64 * 8);
	const edges = new FurEdgeEffect();
	if (marked) edges.mark(square);
	const smooth = draw(64, edges);
	// Of what the eye goes by, the mean of the finer picture's pixels.
	const off = (pixels: Uint8Array) => {
		let sum = 0;
		for (let i = 0; i < 64 * 64; i++) {
			let mean = 0;
			for (let k = 0; k < 64; k++) mean += fine[4 * (((i >> 6) * 8 + (k >> 3)) * 512 + (i & 63) * 8 + (k & 7))] ?? 0;
			sum += ((pixels[4 * i] ?? 0) - mean / 64) ** 2;
		}
		return Math.sqrt(sum / 4096) / 255;
	};
	const alphas = new Set(Array.from({ length: 4096 }, (_, i) => smooth[4 * i + 3]));
	edges.dispose();
	return { plain: off(plain), smooth: off(smooth), opaque: alphas.size === 1 && alphas.has(255) };
}
