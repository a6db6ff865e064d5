/** Runs inside the page: the same fur moved by CPU and GPU. Its answers go to `motion.spec.ts`. */

import {
	Bone,
	type Box3,
	BufferAttribute,
	type DataTexture,
	Matrix4,
	type Object3D,
	Skeleton,
	type Texture,
	Vector3,
	Vector4,
	WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import { dressFur, type Fur, FurMotion, type FurMotionOptions } from '../../../web/fur/index.ts';
import { loadFur } from '../../../web/measure/studio.ts';

const renderer = new WebGLRenderer();
const gl = renderer.getContext() as WebGL2RenderingContext;

/** Displacements, three numbers for each follicle. */
function read({ follicles }: Fur, swing: Texture | undefined): Float32Array {
	const rows = Math.ceil(follicles.count / 256);
	let texels = new Float32Array(4 * 256 * rows);
	if (swing?.isRenderTargetTexture) {
		const framebuffer = gl.createFramebuffer();
		gl.bindFramebuffer(gl.READ_FRAMEBUFFER, framebuffer);
		const { __webglTexture: texture } = renderer.properties.get(swing) as { __webglTexture: WebGLTexture };
		gl.framebufferTexture2D(gl.READ_FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
		gl.readPixels(0, 0, 256, rows, gl.RGBA, gl.FLOAT, texels);
		gl.deleteFramebuffer(framebuffer);
		renderer.resetState();
	} else if (swing) texels = (swing as DataTexture).image.data as Float32Array<ArrayBuffer>;
	return Float32Array.from({ length: 3 * follicles.count }, (_, i) => texels[4 * Math.floor(i / 3) + (i % 3)] ?? 0);
}

const largest = (values: Float32Array) => values.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
const apart = (a: Float32Array, b: Float32Array) => largest(a.map((x, i) => x - (b[i] ?? Number.NaN)));

/** A clock by which everything takes too long. @param growth of each tick over the one before */
function slow(growth = 0.9): () => number {
	let [now, tick] = [0, 1e9];
	return () => {
		tick *= growth;
		now += tick;
		return now;
	};
}

/** Bones by the fur they carry. */
const bones = new WeakMap<Fur, readonly Bone[]>();

/** Lets three bones carry a body, and a morph target stretch it: one more on the left, one on the right, one above. Call it before the first use of follicles. */
function carry(fur: Fur): void {
	const { geometry } = fur.shells;
	const position = geometry.getAttribute('position');
	geometry.computeBoundingBox();
	const { min, max } = geometry.boundingBox as Box3;
	const [joints, weights] = [new Float32Array(4 * position.count), new Float32Array(4 * position.count)];
	for (let i = 0; i < position.count; i++) {
		const along = (position.getX(i) - min.x) / (max.x - min.x);
		const up = 0.3 * ((position.getY(i) - min.y) / (max.y - min.y));
		joints.set([0, 1, 2, 0], 4 * i);
		weights.set([(1 - up) * (1 - along), (1 - up) * along, up, 0], 4 * i);
	}
	geometry.setAttribute('skinIndex', new BufferAttribute(joints, 4));
	geometry.setAttribute('skinWeight', new BufferAttribute(weights, 4));
	const each = [new Bone(), new Bone(), new Bone()];
	const placement = fur.shells.matrix.compose(fur.shells.position, fur.shells.quaternion, fur.shells.scale);
	const skeleton = new Skeleton(
		each,
		each.map(() => placement.clone()),
	);
	const parent = fur.shells.parent as Object3D;
	for (const bone of each) parent.add(bone);
	Object.assign(fur.shells, { skeleton, bindMatrix: new Matrix4() });
	bones.set(fur, each);
	const way = Float32Array.from(
		{ length: 3 * position.count },
		(_, i) => 0.3 * (max.x - min.x) * (weights[4 * Math.floor(i / 3) + 1] as number),
	);
	geometry.morphAttributes.position = [new BufferAttribute(way, 3)];
	Object.assign(fur.ground.skin, { pose: { influences: [0], morphsOf() {}, release() {} } });
}

/** Gusts, a stroke and a body that is carried about. @param frame of 60 a second */
function act(fur: Fur, motion: FurMotion, frame: number): void {
	const { shells, skin } = fur;
	const t = frame / 60;
	motion.wind.strength = 0.6;
	motion.wind.gusts = 1;
	motion.wind.direction.set(1, 0.1, 0.4);
	const place = skin.parent ?? skin;
	place.position.set(0.3 * Math.sin(4 * t), 0, 0);
	place.rotation.set(0.3 * Math.sin(3 * t), t, 0);
	for (const [i, bone] of (bones.get(fur) ?? []).entries()) {
		bone.rotation.set(0.6 * Math.sin(5 * t + i), 0, 0.8 * i * Math.sin(4 * t));
		bone.position.y = 0.1 * Math.sin(6 * t + 2 * i);
	}
	const { influences } = fur.ground.skin.pose ?? {};
	if (influences) (influences as number[])[0] = 0.5 + 0.5 * Math.sin(7 * t);
	const { center, radius } = shells.geometry.boundingSphere ?? { center: new Vector3(), radius: 1 };
	const at = (x: number) =>
		new Vector3(center.x + x * radius, center.y + 0.5 * radius, center.z).applyMatrix4(shells.matrixWorld);
	if (frame % 120 < 30) motion.stroke(at((frame % 120) / 30), at(((frame % 120) + 1) / 30), 0.2);
}

/** A motion that has gone over to the GPU, on a fur of its own. */
async function onGpu(url: string, options: FurMotionOptions = {}): Promise<{ fur: Fur; motion: FurMotion }> {
	const fur = await loadFur(url);
	return { fur, motion: new FurMotion(fur, { ...options, renderer, clock: slow() }) };
}

/** Both go through the same for some seconds. @param jointed whether bones carry them, which move too */
export async function agree(url: string, seconds: number, jointed = false) {
	const [fur, other] = [await loadFur(url), await loadFur(url)];
	if (jointed) for (const each of [fur, other]) carry(each);
	const cpu = new FurMotion(fur, { seed: 5 });
	const gpu = new FurMotion(other, { seed: 5, renderer, clock: slow() });
	const distances: number[] = [];
	let [jump, swung, moved] = [0, 0, false];
	for (let frame = 0; frame < 60 * seconds; frame++) {
		const before = gpu.processor;
		for (const [each, motion] of [
			[fur, cpu],
			[other, gpu],
		] as const) {
			act(each, motion, frame);
			each.update(1 / 60);
		}
		const took = before !== gpu.processor;
		moved ||= took;
		// Reading waits for the GPU.
		if (!took && frame % 20 > 0) continue;
		const [a, b] = [read(fur, fur.swing), read(other, other.swing)];
		swung = Math.max(swung, largest(a));
		if (took) jump = apart(a, b);
		if (moved) distances.push(apart(a, b));
	}
	const result = {
		count: fur.follicles.count,
		processors: [cpu.processor, gpu.processor],
		jump,
		swung,
		apart: Math.max(...distances),
		error: gl.getError(),
	};
	for (const part of [cpu, gpu, fur, other]) part.dispose();
	return result;
}

/** Which of them moves fur for which both take too long, but the GPU longer. */
export async function slower(url: string) {
	const fur = await loadFur(url);
	const motion = new FurMotion(fur, { renderer, clock: slow(1.1) });
	for (let frame = 0; frame < 60; frame++) {
		act(fur, motion, frame);
		fur.update(1 / 60);
	}
	const result = { processor: motion.processor, swung: largest(read(fur, fur.swing)), error: gl.getError() };
	motion.dispose();
	fur.dispose();
	return result;
}

/** Whether a body and what is dressed on it have a displacement while they move, and when the motion is over, on CPU and GPU. */
export async function ends(url: string) {
	const { fur, motion: gpu } = await onGpu(url);
	const other = dressFur(fur, fur);
	const bent: boolean[] = [];
	for (const motion of [new FurMotion(fur), gpu]) {
		fur.motion = other.motion = motion;
		for (let frame = 0; frame < 40; frame++) {
			act(fur, motion, frame);
			fur.update(1 / 60);
		}
		bent.push(fur.swing !== undefined, other.swing !== undefined);
		motion.dispose();
		bent.push(fur.swing !== undefined, other.swing !== undefined);
	}
	const processor = gpu.processor;
	for (const each of [other, fur]) each.dispose();
	return { bent, processor, error: gl.getError() };
}

/** What is left of the renderer's own state, and of a motion whose context was lost. */
export async function leaves(url: string) {
	const { fur, motion } = await onGpu(url);
	const target = new WebGLRenderTarget(40, 30);
	target.scissor.set(3, 4, 5, 6);
	target.scissorTest = true;
	renderer.setRenderTarget(target);
	renderer.setClearColor(0x123456, 0.5);
	for (let frame = 0; frame < 40; frame++) {
		act(fur, motion, frame);
		fur.update(1 / 60);
	}
	const four = (name: number): number[] => [...gl.getParameter(name)];
	const kept = {
		target: renderer.getRenderTarget() === target,
		box: four(gl.SCISSOR_BOX),
		view: [...four(gl.VIEWPORT), ...renderer.getCurrentViewport(new Vector4()).toArray()],
		scissor: gl.isEnabled(gl.SCISSOR_TEST),
		autoClear: renderer.autoClear,
		alpha: renderer.getClearAlpha(),
	};
	renderer.setRenderTarget(null);
	const swung = largest(read(fur, fur.swing));

	const lose = gl.getExtension('WEBGL_lose_context') as WEBGL_lose_context;
	const restored = new Promise((resolve) => renderer.domElement.addEventListener('webglcontextrestored', resolve));
	lose.loseContext();
	await new Promise((resolve) => setTimeout(resolve));
	motion.wind.strength = 0;
	const { skin } = fur;
	const during = fur.update(1 / 60);
	lose.restoreContext();
	await restored;
	skin.parent?.updateMatrixWorld();
	fur.update(1 / 240);
	const after = largest(read(fur, fur.swing));
	let frames = 0;
	while (fur.update(1 / 60) && frames < 2000) frames++;
	const result = { kept, swung, during, after, frames, asleep: motion.asleep, error: gl.getError() };
	motion.dispose();
	fur.dispose();
	return result;
}
