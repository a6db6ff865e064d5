/** Runs inside the page: a herd of one character. Its answers go to `herdPoses.spec.ts`. */

import {
	AnimationMixer,
	type Group,
	Matrix4,
	Mesh,
	MeshStandardMaterial,
	type Object3D,
	Sphere,
	SphereGeometry,
	Vector3,
	WebGLRenderer,
} from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { type Fur, FurInstances, FurLoaderPlugin, fitFurShadow } from '../../../web/fur/index.ts';
import { psnr, Stand } from './Stand.ts';

const SIZE = 240;
const renderer = new WebGLRenderer({ antialias: false });
renderer.info.autoReset = false;
renderer.shadowMap.enabled = true;

/** Share of the clip, and place along x. */
export type Body = [share: number, x: number];

/** Bodies on a ground under a lamp that casts shadows. */
class Stage extends Stand {
	/** @param reach radius of all bodies, world units */
	constructor(fur: Fur, reach: number) {
		super(renderer, SIZE);
		this.lamp.position.set(-1, 1.2, 0.6).multiplyScalar(5 * reach);
		fitFurShadow(this.lamp, new Sphere(new Vector3(), reach), fur.asset.length);
		this.addGround(-0.5 * reach, 20 * reach);
		this.camera.fov = 30;
		this.camera.updateProjectionMatrix();
		this.camera.position.set(0.4 * reach, 0.8 * reach, 4.4 * reach);
		this.camera.lookAt(0, 0, 0);
		this.camera.updateMatrixWorld();
	}

	override draw(): Float32Array {
		renderer.info.reset();
		return super.draw();
	}
}

class Character {
	readonly fur: Fur;
	readonly root: Group;
	readonly #mixer: AnimationMixer;
	readonly #seconds: number;

	static async load(url: string): Promise<Character> {
		const loader = new GLTFLoader().register((parser) => new FurLoaderPlugin(parser));
		return new Character(await loader.loadAsync(url));
	}

	private constructor({ scene, animations, userData }: Awaited<ReturnType<GLTFLoader['loadAsync']>>) {
		const [clip] = animations;
		if (!clip) throw new Error('no clip');
		this.fur = userData.fur;
		this.root = scene;
		this.#seconds = clip.duration;
		this.#mixer = new AnimationMixer(scene);
		this.#mixer.clipAction(clip).play();
		// An eye on a joint.
		const eye = new Mesh(new SphereGeometry(0.12), new MeshStandardMaterial({ color: 0x203040, roughness: 0.4 }));
		eye.position.set(0.1, 0.4, 0.2);
		this.fur.shells.skeleton?.bones.at(-1)?.add(eye);
	}

	/** @param joints whether they alone move: bodies of a herd share the weights of morph targets */
	pose(share: number, joints = false): void {
		const { morphTargetInfluences: weights } = this.fur.skin as Mesh;
		const before = [...(weights ?? [])];
		this.#mixer.setTime(share * this.#seconds);
		if (joints) for (const [i, weight] of before.entries()) weights?.splice(i, 1, weight);
	}
}

function differences(one: Float32Array, other: Float32Array): { psnr: number; worst: number } {
	const off = one.map((value, i) => Math.abs(value - (other[i] as number)));
	return { psnr: psnr(one, other), worst: off.sort().at(-1 - 4 * 12) as number };
}

/** A character in a pose by itself, beside a herd of one: by the present pose, and by a kept one. */
export async function alone(url: string, share: number) {
	const character = await Character.load(url);
	const { fur, root } = character;
	const stage = new Stage(fur, 1.2);
	const other = new Stage(fur, 1.2);
	character.pose(share);
	stage.scene.add(root);
	const plain = stage.draw();
	const herd = new FurInstances(fur, 1);
	herd.height = SIZE;
	herd.fewestShells = fur.asset.layers;
	root.removeFromParent();
	other.scene.add(herd);
	const present = other.draw();
	herd.capturePose(5);
	herd.setPoseAt(0, 5);
	character.pose(0, true);
	const kept = other.draw();
	character.pose(1, true);
	const still = other.draw();
	herd.dispose();
	fur.dispose();
	return {
		present: differences(plain, present),
		kept: differences(plain, kept),
		still: differences(kept, still).worst,
	};
}

const furDraws = (part: Object3D) => /^(fins of )?fur, up to/.test(part.name) && part.visible;

/** Several bodies of one herd in poses of their own, beside a herd for each of them. */
export async function together(url: string, bodies: Body[]) {
	const character = await Character.load(url);
	const { fur } = character;
	const herdOf = (some: readonly Body[]) => {
		const herd = new FurInstances(fur, some.length);
		herd.height = SIZE;
		for (const [i, [share, x]] of some.entries()) {
			character.pose(share);
			herd.capturePose(i % 8);
			herd.setMatrixAt(i, new Matrix4().makeTranslation(x, 0, 0));
			herd.setPoseAt(i, i % 8);
		}
		return herd;
	};
	const stage = new Stage(fur, 3);
	const one = herdOf(bodies);
	stage.scene.add(one);
	const picture = stage.draw();
	const { calls } = renderer.info.render;
	const levels = one.children.filter((part) => /^fur, up to/.test(part.name) && part.visible).length;
	const draws = one.children.filter(furDraws).length;
	one.removeFromParent();
	const each = bodies.map((body) => herdOf([body]));
	for (const herd of each) stage.scene.add(herd);
	const apart = stage.draw();
	for (const herd of each) herd.removeFromParent();
	const same = herdOf(bodies.map(([, x]) => [0, x]));
	stage.scene.add(same);
	const unposed = stage.draw();
	for (const herd of [one, same, ...each]) herd.dispose();
	fur.dispose();
	return { apart: differences(picture, apart), unposed: differences(picture, unposed), levels, draws, calls };
}
