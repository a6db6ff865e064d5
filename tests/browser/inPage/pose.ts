/** Runs inside the page: characters in poses, their vertices and pictures. Its answers go to `pose.spec.ts`. */

import {
	AnimationMixer,
	FloatType,
	type Mesh,
	type Object3D,
	Quaternion,
	ShaderMaterial,
	Sphere,
	UniformsLib,
	UniformsUtils,
	Vector3,
	WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import { type GLTF, GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { clone } from 'three/addons/utils/SkeletonUtils.js';
import { Fur, FurLoaderPlugin } from '../../../web/fur/index.ts';
import { renderFloats } from '../../../web/measure/studio.ts';
import { placesOf } from './places.ts';
import { psnr, Stand } from './Stand.ts';

const SIZE = 160;
const renderer = new WebGLRenderer({ antialias: false });
renderer.shadowMap.enabled = true;
const gl = renderer.getContext() as WebGL2RenderingContext;

/** A character in a scene of its own. */
class Character extends Stand {
	readonly mixer: AnimationMixer;
	readonly fur: Fur;

	constructor(readonly gltf: GLTF) {
		super(renderer, SIZE);
		this.fur = gltf.userData.fur;
		this.mixer = new AnimationMixer(gltf.scene);
		this.scene.add(gltf.scene);
		this.look(this.fur.bounds(new Sphere()));
		this.fur.shells.shellCount = 8;
	}

	static async load(url: string): Promise<Character> {
		const loader = new GLTFLoader().register((parser) => new FurLoaderPlugin(parser));
		return new Character(await loader.loadAsync(url));
	}

	look({ center, radius }: Sphere): void {
		this.camera.position
			.set(0.4, 0.5, 1)
			.multiplyScalar(6 * radius)
			.add(center);
		this.camera.lookAt(center);
		this.camera.near = radius;
		this.camera.far = 20 * radius;
		this.camera.updateProjectionMatrix();
	}

	/** A moment of a clip; undefined: at rest. */
	pose(clip: string | undefined, seconds: number): void {
		this.mixer.stopAllAction();
		const found = this.gltf.animations.find(({ name }) => name === clip);
		if (!found) return;
		this.mixer.clipAction(found).play();
		this.mixer.setTime(seconds);
	}

	override dispose(): void {
		this.fur.dispose();
		super.dispose();
	}
}

/** Where the GPU has the vertices of shells and fins at moments of clips, and the bounds of body and fur there. */
export async function vertices(url: string, moments: [clip: string | undefined, seconds: number][]) {
	const stand = await Character.load(url);
	const { fur } = stand;
	const answers = moments.map(([clip, seconds]) => {
		stand.pose(clip, seconds);
		stand.draw();
		const { center, radius } = fur.bounds(new Sphere());
		const reach = 2 * (center.length() + radius);
		const fins = fur.fins && placesOf(renderer, fur.fins as never, reach);
		// Fins are cut into strips from root to tip: a root per strip.
		const rows = fur.fins ? fur.fins.geometry.getAttribute('position').count / 2 : 0;
		return {
			...{ shells: placesOf(renderer, fur.shells as never, reach), fins, rows },
			...{ center: center.toArray(), radius, length: fur.asset.length },
		};
	});
	stand.dispose();
	return { answers, error: gl.getError() };
}

/**
 * Pixels inside the outline of the skin that the surface below the shells leaves open, at moments of a clip: with hairs of no
 * length and full coverage, and the skin hidden.
 *
 * @param size of the pictures, pixels
 */
export async function cracks(url: string, moments: [clip: string | undefined, seconds: number][], size: number) {
	const stand = await Character.load(url);
	const { fur, scene, camera } = stand;
	const { shells, fins, skin } = fur;
	const target = new WebGLRenderTarget(size, size, { type: FloatType });
	if (fins) fins.visible = false;
	const { material } = shells;
	const closed = new ShaderMaterial({
		glslVersion: material.glslVersion,
		lights: material.lights,
		uniforms: { ...material.uniforms, ...UniformsUtils.clone(UniformsLib.lights), furLength: { value: 0 } },
		defines: { ...material.defines },
		vertexShader: material.vertexShader,
		fragmentShader: 'out vec4 colour; void main() { colour = vec4(1.0); }',
	});
	Object.assign(closed, { crispness: material.crispness });
	Object.assign(closed.defaultAttributeValues, material.defaultAttributeValues);
	delete closed.defines.BODY_LIGHT;
	const counts = moments.map(([clip, seconds]) => {
		stand.pose(clip, seconds);
		stand.look(fur.bounds(new Sphere()));
		fur.visible = false;
		const body = renderFloats(renderer, scene, camera, target);
		fur.visible = true;
		skin.visible = false;
		Object.assign(shells, { material: closed });
		const hairs = renderFloats(renderer, scene, camera, target);
		Object.assign(shells, { material });
		skin.visible = true;
		const isBody = (i: number) => (body[4 * i + 3] ?? 0) > 0.5;
		let [inside, open] = [0, 0];
		const where: number[] = [];
		for (let i = size; i < size * (size - 1); i++) {
			// On the outline itself two shaders may round to either side.
			if (![i, i - 1, i + 1, i - size, i + size].every(isBody)) continue;
			inside++;
			if ((hairs[4 * i + 3] ?? 0) < 0.5) where.push(i % size, Math.floor(i / size), open++);
		}
		return { inside, open, where };
	});
	closed.dispose();
	target.dispose();
	stand.dispose();
	return { counts, error: gl.getError() };
}

/** Pictures of a clip with the fins that are seen and with all of them: in decibels, and the share that is drawn. */
export async function seenFins(url: string, clip: string, moments: number[]) {
	const stand = await Character.load(url);
	const { fins } = stand.fur;
	if (!fins) throw new Error('no fins');
	/** Bytes of the indices on the GPU. */
	const indices = new Map<WebGLBuffer, number>();
	const { deleteBuffer } = gl;
	const bufferData = gl.bufferData as (...given: unknown[]) => void;
	gl.bufferData = (...given: unknown[]) => {
		const [target, data] = given;
		if (target === gl.ELEMENT_ARRAY_BUFFER)
			indices.set(gl.getParameter(gl.ELEMENT_ARRAY_BUFFER_BINDING), (data as ArrayBufferView).byteLength);
		bufferData.apply(gl, given);
	};
	gl.deleteBuffer = (buffer) => {
		if (buffer) indices.delete(buffer);
		deleteBuffer.call(gl, buffer);
	};
	const bytes = fins.geometry.index?.array.byteLength;
	const kept = () => [...indices.values()].filter((one) => one === bytes).length;
	const answers = moments.map((seconds) => {
		stand.pose(clip, seconds);
		stand.look(stand.fur.bounds(new Sphere()));
		stand.draw();
		let share = 1;
		const restore = fins.onAfterRender;
		fins.onAfterRender = (...given) => {
			const { index, drawRange } = fins.geometry;
			share = drawRange.count / (index?.count ?? 0);
			restore.apply(fins, given);
		};
		// The second time the body stands still.
		const some = stand.draw();
		fins.onAfterRender = restore;
		const before = fins.onBeforeRender;
		fins.onBeforeRender = () => {};
		const all = stand.draw();
		fins.visible = false;
		const none = stand.draw();
		Object.assign(fins, { visible: true, onBeforeRender: before });
		return { share, alike: psnr(some, all), without: psnr(none, all) };
	});
	const both = kept();
	stand.dispose();
	const left = kept();
	Object.assign(gl, { bufferData, deleteBuffer });
	return { answers, both, left, error: gl.getError() };
}

/** Turns an object about the world's origin. */
function turn(object: Object3D, angle: number): void {
	const by = new Quaternion().setFromAxisAngle(new Vector3(0.5, 1, 0.3).normalize(), angle);
	object.position.applyQuaternion(by);
	object.quaternion.premultiply(by);
}

/** A still body, turned, and the same as a character, turned by its first joint; in decibels. */
export async function turned(still: string, moving: string, shadows: boolean) {
	const [node, joint] = [await Character.load(still), await Character.load(moving)];
	const pictures: Float32Array[] = [];
	for (const stand of [node, joint]) {
		stand.lamp.castShadow = shadows;
		Object.assign(stand.lamp.shadow.camera, { left: -2, right: 2, bottom: -2, top: 2, near: 0.1, far: 8 });
		stand.lamp.position.multiplyScalar(3);
		stand.camera.near = 0.1;
		stand.camera.far = 100;
		stand.camera.updateProjectionMatrix();
		stand.camera.position.set(1, 2, 8);
		stand.camera.lookAt(0, 0.5, 0);
	}
	for (const angle of [0, 1, 2.5]) {
		for (const stand of [node, joint]) {
			const [first] = stand.fur.shells.skeleton?.bones ?? [];
			const object = first ?? stand.gltf.scene;
			turn(object, angle);
			pictures.push(stand.draw());
			turn(object, -angle);
		}
	}
	const alike = [0, 2, 4].map((i) => psnr(pictures[i] as Float32Array, pictures[i + 1] as Float32Array));
	const apart = psnr(pictures[0] as Float32Array, pictures[2] as Float32Array);
	for (const stand of [node, joint]) stand.dispose();
	return { alike, apart, error: gl.getError() };
}

/** A character and its copy: what moves with whom, and what is left of both. */
export async function twins(url: string) {
	const { geometries, textures } = renderer.info.memory;
	const stand = await Character.load(url);
	const alone = stand.draw();
	const twin = clone(stand.gltf.scene);
	const fur = Fur.of(twin);
	if (!fur) throw new Error('no fur');
	stand.scene.remove(stand.gltf.scene);
	stand.scene.add(twin);
	const copied = stand.draw();
	// The copy moves, the original stays.
	const mixer = new AnimationMixer(twin);
	const [clip] = stand.gltf.animations;
	if (clip) mixer.clipAction(clip).play();
	mixer.setTime(0.4);
	const moved = stand.draw();
	stand.scene.add(stand.gltf.scene);
	stand.scene.remove(twin);
	const original = stand.draw();
	stand.pose(clip?.name, 0.4);
	const both = stand.draw();
	stand.pose(undefined, 0);
	const own = {
		skin: fur.skin !== stand.fur.skin && fur.skin.parent === twin,
		skeleton: fur.shells.skeleton === (fur.skin as Mesh & { skeleton?: unknown }).skeleton,
		material: fur.material !== stand.fur.material,
		textures: fur.textures === stand.fur.textures,
	};
	// The first to go is the original; the copy is drawn as before.
	stand.fur.dispose();
	stand.scene.remove(stand.gltf.scene);
	stand.scene.add(twin);
	const left = stand.draw();
	fur.dispose();
	stand.dispose();
	const kept = {
		geometries: renderer.info.memory.geometries - geometries,
		textures: renderer.info.memory.textures - textures,
	};
	return {
		own,
		copied: psnr(copied, alone),
		moved: psnr(moved, alone),
		original: psnr(original, alone),
		both: psnr(both, moved),
		left: psnr(left, moved),
		kept,
		error: gl.getError(),
	};
}
