import {
	type Camera,
	DirectionalLight,
	FloatType,
	Group,
	HalfFloatType,
	HemisphereLight,
	type Light,
	Mesh,
	MeshBasicMaterial,
	PerspectiveCamera,
	Scene,
	Sphere,
	type Vector3,
	type WebGLRenderer,
	WebGLRenderTarget,
} from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { type Fur, type FurLoaderOptions, FurLoaderPlugin } from '../fur/index.ts';

const FIELD_OF_VIEW = 20; // vertical, degrees

/** @param url of an asset's model.gltf */
export async function loadFur(url: string, options: FurLoaderOptions = {}): Promise<Fur> {
	const loader = new GLTFLoader().register((parser) => new FurLoaderPlugin(parser, options));
	return (await loader.loadAsync(url)).userData.fur;
}

/** Picture as floats, rgba, premultiplied, over nothing or, with a `ground` of 1, over white; row by row from the bottom. */
export function renderFloats(
	renderer: WebGLRenderer,
	scene: Scene,
	camera: Camera,
	target: WebGLRenderTarget,
	ground: 0 | 1 = 0,
): Float32Array {
	renderer.setRenderTarget(target);
	renderer.setClearColor(ground && 0xffffff, ground);
	renderer.clear();
	renderer.render(scene, camera);
	const pixels = new Float32Array(target.width * target.height * 4);
	renderer.readRenderTargetPixels(target, 0, 0, target.width, target.height, pixels);
	return pixels;
}

/** Means of blocks of `samples` × `samples` pixels, rgba. */
function averaged(fine: Float32Array, width: number, height: number, samples: number): Float32Array {
	const mean = new Float32Array(width * height * 4);
	const weight = 1 / samples ** 2;
	for (let y = 0; y < height * samples; y++)
		for (let x = 0; x < width * samples; x++) {
			const to = (Math.floor(y / samples) * width + Math.floor(x / samples)) * 4;
			const from = (y * width * samples + x) * 4;
			for (let c = 0; c < 4; c++) mean[to + c] = (mean[to + c] ?? 0) + weight * (fine[from + c] ?? 0);
		}
	return mean;
}

/** View of a whole model over nothing, centred and filling the picture's height, lit from the left and by the sky. */
export class Studio {
	/** Radius of the skin, model units. */
	readonly radius: number;
	/** Pixels per model unit at its centre. */
	readonly scale: number;
	readonly #renderer: WebGLRenderer;
	readonly #scene = new Scene();
	readonly #lights = new Group();
	readonly #camera: PerspectiveCamera;
	readonly #centre: Sphere['center'];
	readonly #distance: number;
	readonly #picture: WebGLRenderTarget;
	/** Half floats, as in the demo. */
	readonly #frame: WebGLRenderTarget;

	constructor(
		renderer: WebGLRenderer,
		readonly fur: Fur,
		width: number,
		height: number,
	) {
		this.#renderer = renderer;
		const lamp = new DirectionalLight(0xffffff, 6);
		lamp.position.set(-1, 0.6, 0.6);
		this.light(lamp, new HemisphereLight(0xffffff, 0x808080, 2));
		this.#scene.add(fur.skin.parent ?? fur.skin, this.#lights);
		this.#scene.updateMatrixWorld(true);
		const body = new Sphere().makeEmpty();
		fur.skin.traverse((piece) => {
			if (!(piece instanceof Mesh)) return;
			piece.geometry.computeBoundingSphere();
			body.union(piece.geometry.boundingSphere.clone().applyMatrix4(piece.matrixWorld));
		});
		this.#centre = body.center;
		this.radius = body.radius;
		const slope = Math.tan(((FIELD_OF_VIEW / 2) * Math.PI) / 180);
		this.#distance = (1.25 * body.radius) / slope;
		this.scale = height / (2 * this.#distance * slope);
		this.#camera = new PerspectiveCamera(FIELD_OF_VIEW, width / height, 0.1 * body.radius, 100 * body.radius);
		this.#picture = new WebGLRenderTarget(width, height, { type: FloatType });
		this.#frame = new WebGLRenderTarget(width, height, { type: HalfFloatType });
		this.look();
	}

	/**
	 * @param azimuth radians from the front to the model's left
	 * @param polar radians from straight above
	 * @param distance over that at which the model fills the picture
	 */
	look(azimuth = 0, polar = Math.PI / 2, distance = 1): void {
		this.#camera.position.setFromSphericalCoords(this.#distance * distance, polar, azimuth).add(this.#centre);
		this.#camera.lookAt(this.#centre);
	}

	/** Unit vector of the world. @param direction seen from the eye: right, up, to the viewer */
	fromEye(direction: Vector3): Vector3 {
		this.#camera.updateMatrixWorld();
		return direction.clone().transformDirection(this.#camera.matrixWorld);
	}

	/** Bounding sphere of the body with its fur, world units. */
	get bounds(): Sphere {
		return new Sphere(this.#centre.clone(), this.radius + this.fur.asset.length);
	}

	/** Replaces the lights. */
	light(...lights: Light[]): void {
		this.#lights.clear();
		this.#lights.add(...lights);
	}

	/** Make the body, eyes included, an invisible occluder. */
	showFurAlone(): void {
		const hidden = new MeshBasicMaterial({ colorWrite: false });
		this.#scene.traverse((piece) => {
			if (piece instanceof Mesh && piece !== this.fur.shells && piece !== this.fur.fins) piece.material = hidden;
		});
	}

	/** @param shells 0 for none, 'auto' for as many as the picture needs */
	showFur(shells: number | 'auto', fins: boolean): void {
		this.fur.shells.visible = shells !== 0;
		if (shells === 'auto') this.fur.shells.automatic = true;
		else if (shells > 0) this.fur.shells.shellCount = shells;
		if (this.fur.fins) this.fur.fins.visible = fins;
	}

	/**
	 * @param samples per pixel and axis
	 * @returns rgba, premultiplied; row by row from the bottom
	 */
	draw(samples = 1): Float32Array {
		const { width, height } = this.#picture;
		this.#picture.setSize(width * samples, height * samples);
		const pixels = renderFloats(this.#renderer, this.#scene, this.#camera, this.#picture);
		this.#picture.setSize(width, height);
		return samples > 1 ? averaged(pixels, width, height, samples) : pixels;
	}

	/** Draws to the renderer's canvas. */
	show(): void {
		this.#renderer.setRenderTarget(null);
		this.#renderer.render(this.#scene, this.#camera);
	}

	/** Milliseconds of one frame up to the GPU's end, by reading a pixel. */
	time(): number {
		const start = performance.now();
		this.#renderer.setRenderTarget(this.#frame);
		this.#renderer.render(this.#scene, this.#camera);
		this.#renderer.readRenderTargetPixels(this.#frame, 0, 0, 1, 1, new Uint16Array(4));
		return performance.now() - start;
	}

	/** Frees the fur and its targets; the renderer is the caller's. */
	dispose(): void {
		this.fur.dispose();
		this.#picture.dispose();
		this.#frame.dispose();
	}
}
