/** Runs inside the page: many bodies of one asset, without the demo. Its answers go to `instances.spec.ts`. */

import { MeshoptSimplifier } from 'meshoptimizer';
import {
	DirectionalLight,
	FloatType,
	HemisphereLight,
	Matrix4,
	Mesh,
	MeshStandardMaterial,
	type Object3D,
	OrthographicCamera,
	PerspectiveCamera,
	PlaneGeometry,
	Scene,
	Sphere,
	Vector3,
	WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import { type Fur, FurInstances, fitFurShadow } from '../../../web/fur/index.ts';
import { loadFur, renderFloats } from '../../../web/measure/studio.ts';
import { removeWhiskers, toBase64 } from './Stand.ts';

await MeshoptSimplifier.ready;
const renderer = new WebGLRenderer({ antialias: false });
renderer.info.autoReset = false;
const gl = renderer.getContext() as WebGL2RenderingContext;

/** Calls of these functions of the context since the page was opened. */
const made: Record<string, number> = {};
for (const name of ['bufferData', 'bufferSubData', 'createBuffer', 'deleteBuffer', 'texSubImage3D'] as const) {
	const own = gl[name] as (...args: unknown[]) => unknown;
	made[name] = 0;
	Object.assign(gl, {
		[name](...args: unknown[]) {
			made[name] = (made[name] ?? 0) + 1;
			return own.apply(gl, args);
		},
	});
}
const calls = (...names: string[]) => names.reduce((sum, name) => sum + (made[name] ?? 0), 0);
const buffers = () => calls('createBuffer') - calls('deleteBuffer');

/** Draws no pixel from now on: for what is counted. */
export function blind(): void {
	for (const how of ['drawArrays', 'drawElements', 'drawElementsInstanced'] as const) gl[how] = () => {};
}

/** Where a body stands: x, y, z, turn about y in radians, size. */
export type Place = [x: number, y: number, z: number, yaw?: number, size?: number];

function matrixOf([x, y, z, yaw = 0, size = 1]: Place): Matrix4 {
	return new Matrix4()
		.makeRotationY(yaw)
		.scale(new Vector3(size, size, size))
		.setPosition(x, y, z);
}

export interface Wanted {
	places: Place[];
	/** together in one FurInstances, each in one of its own, or the plain fur at the first place */
	as?: 'one' | 'each' | 'plain';
	levels?: number[];
	/** far bodies without overlaps, and with fewer faces */
	far?: 'apart' | 'fewer';
	eye?: [number, number, number];
	target?: [number, number, number];
	/** pixels */
	size?: number;
	fins?: boolean;
	parallel?: boolean;
	/** highlights and light from behind, switched on after a first draw */
	shiny?: boolean;
	/** length of the fur over what it was, changed after a first draw */
	shorter?: number;
	/** on a ground, with a lamp that casts shadows */
	shadow?: boolean;
	/** without whiskers, which in a herd are a pixel wide at least */
	shorn?: boolean;
}

export interface Drawn {
	/** rgba, premultiplied, base64 of float32, rows from the bottom */
	picture: string;
	calls: number;
	triangles: number;
	/** in the order of the draws: most shells of a level that draws, and its bodies */
	levels: [most: number, bodies: number][];
	/** of the first body */
	shells: number;
	/** uploads of buffers meanwhile */
	uploads: number;
}

class Herd {
	readonly scene = new Scene();
	readonly lamp = new DirectionalLight(0xffffff, 6);
	readonly bodies: FurInstances[];
	readonly camera: PerspectiveCamera | OrthographicCamera;
	readonly target: WebGLRenderTarget;
	readonly ground = new Mesh(new PlaneGeometry(20, 20).rotateX(-Math.PI / 2), new MeshStandardMaterial());

	constructor(
		readonly fur: Fur,
		{ places, as = 'one', levels, eye = [0, 1, 8], target = [0, 0, 0], size = 200, ...wanted }: Wanted,
	) {
		this.lamp.position.set(-1, 0.6, 0.6);
		this.scene.add(this.lamp, this.lamp.target, new HemisphereLight(0xffffff, 0x808080, 2));
		renderer.shadowMap.enabled = wanted.shadow ?? false;
		if (wanted.shadow) {
			this.ground.position.y = -1;
			this.ground.receiveShadow = true;
			this.scene.add(this.ground);
			this.lamp.position.multiplyScalar(5);
			fitFurShadow(this.lamp, new Sphere(new Vector3(), 4), fur.asset.length);
		}
		if (wanted.shorn) removeWhiskers(fur.skin.parent ?? fur.skin);
		if (fur.fins) fur.fins.visible = wanted.fins ?? true;
		this.camera = wanted.parallel
			? new OrthographicCamera(-2, 2, 2, -2, 0.05, 200)
			: new PerspectiveCamera(30, 1, 0.05, 200);
		this.camera.position.fromArray(eye);
		this.camera.lookAt(...target);
		this.camera.updateMatrixWorld();
		this.target = new WebGLRenderTarget(size, size, { type: FloatType });

		this.bodies = (as === 'each' ? places.map((place) => [place]) : [places]).map((group) => {
			const bodies = new FurInstances(fur, group.length, levels);
			bodies.height = size;
			if (wanted.far) bodies.simplify(wanted.far === 'fewer' ? MeshoptSimplifier : undefined);
			if (places.length === 1) bodies.fewestShells = fur.asset.layers; // as the fur by itself
			for (const [i, place] of group.entries()) bodies.setMatrixAt(i, matrixOf(place));
			return bodies;
		});
		if (as !== 'plain') this.scene.add(...this.bodies);
		else {
			const root = fur.skin.parent ?? fur.skin;
			root.applyMatrix4(matrixOf(places[0] as Place));
			this.scene.add(root);
		}
		if (wanted.shiny) {
			this.draw();
			Object.assign(fur.shells.material, { gloss: 2, backlight: 6 });
		}
		if (wanted.shorter) {
			this.draw();
			fur.shells.furLength *= wanted.shorter;
		}
	}

	draw(): Drawn {
		const before = calls('bufferData', 'bufferSubData');
		renderer.info.reset();
		const picture = toBase64(new Uint8Array(renderFloats(renderer, this.scene, this.camera, this.target).buffer));
		const { calls: draws, triangles } = renderer.info.render;
		const levels = this.bodies.flatMap(({ children }) => children.flatMap(levelOf));
		const uploads = calls('bufferData', 'bufferSubData') - before;
		return { picture, calls: draws, triangles, levels, shells: this.bodies[0]?.getShellsAt(0) ?? 0, uploads };
	}

	dispose(): void {
		for (const bodies of this.bodies) bodies.dispose();
		this.target.dispose();
		this.lamp.dispose();
		this.ground.geometry.dispose();
		this.ground.material.dispose();
	}
}

function levelOf(part: Object3D): [number, number][] {
	const most = Number(/^fur, up to (\d+) shells/.exec(part.name)?.[1]);
	const { geometry } = part as Mesh;
	return most && part.visible ? [[most, (geometry as never as { instanceCount: number }).instanceCount / most]] : [];
}

export async function draw(url: string, wanted: Wanted): Promise<Drawn> {
	const herd = new Herd(await loadFur(url), wanted);
	const drawn = herd.draw();
	herd.dispose();
	herd.fur.dispose();
	return drawn;
}

/** The first body just before and just after it has more than `shells`, by moving the camera along z. */
export async function border(url: string, wanted: Wanted, shells: number): Promise<[more: Drawn, fewer: Drawn]> {
	const herd = new Herd(await loadFur(url), wanted);
	const [bodies] = herd.bodies as [FurInstances];
	const { position } = herd.camera;
	const stand = (z: number) => {
		position.z = z;
		herd.camera.updateMatrixWorld();
		bodies.update(herd.camera);
		return bodies.getShellsAt(0);
	};
	let [near, far] = [2, 40];
	for (let i = 0; i < 30; i++) {
		const middle = (near + far) / 2;
		if (stand(middle) > shells) near = middle;
		else far = middle;
	}
	const drawn = [near, far].map((z) => {
		stand(z);
		return herd.draw();
	});
	herd.dispose();
	herd.fur.dispose();
	return drawn as [Drawn, Drawn];
}

/** Uploads of each frame, one after the other: the first, a still one, then each after what has changed. */
export async function frames(url: string, wanted: Wanted): Promise<Record<string, number>> {
	const herd = new Herd(await loadFur(url), wanted);
	const [bodies] = herd.bodies as [FurInstances];
	const uploads: Record<string, number> = {};
	const frame = (name: string) => {
		uploads[name] = herd.draw().uploads;
	};
	frame('first');
	frame('still');
	herd.lamp.position.x = 1;
	frame('lamp');
	herd.camera.position.z -= 5;
	frame('camera');
	frame('still again');
	bodies.setMatrixAt(0, matrixOf([0.3, 0, 0]));
	frame('body');
	bodies.count -= 1;
	frame('fewer');
	frame('at last');
	herd.dispose();
	herd.fur.dispose();
	return uploads;
}

/** What there is on the GPU: the plain fur drawn, bodies drawn, bodies disposed of; and the plain fur's pictures. */
export async function memory(url: string, wanted: Wanted) {
	const fur = await loadFur(url);
	const plain = new Scene().add(new HemisphereLight(), fur.skin.parent ?? fur.skin);
	const counts: { buffers: number; geometries: number; planes: number }[] = [];
	const pictures: string[] = [];
	const look = (herd: Herd) => {
		const pixels = renderFloats(renderer, plain, herd.camera, herd.target);
		pictures.push(toBase64(new Uint8Array(pixels.buffer)));
		const { geometries } = renderer.info.memory;
		counts.push({ buffers: buffers(), geometries, planes: calls('texSubImage3D') });
	};
	const herd = new Herd(fur, wanted);
	look(herd);
	herd.draw();
	look(herd);
	herd.dispose();
	look(herd);
	herd.target.dispose();
	fur.dispose();
	return { counts, pictures };
}
