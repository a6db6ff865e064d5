/** `scene.environment` as spherical harmonics of order 2, which light fur as those of a light probe do. */

import {
	CubeCamera,
	type CubeTexture,
	FloatType,
	HalfFloatType,
	Matrix4,
	type Object3D,
	Scene,
	SphericalHarmonics3,
	type Texture,
	Vector3,
	WebGLCubeRenderTarget,
	type WebGLRenderer,
} from 'three';
import { LightProbeGenerator } from 'three/addons/lights/LightProbeGenerator.js';

/** Pixels along the face of the cube in which a map is read. */
const SIZE = 64;
/** Roughness of three's blurred copy of the map that is read: a sun would fall between the pixels of a sharper one. */
const BLUR = 0.1;
/** Readings of a map that may fail in a row. */
const TRIES = 3;

/** Points and weights whose sums are integrals over the sphere up to degree 5: faces and corners of a cube. */
const RULE = [-1, 0, 1]
	.flatMap((x) => [-1, 0, 1].flatMap((y) => [-1, 0, 1].map((z) => new Vector3(x, y, z))))
	.filter((point) => point.manhattanLength() % 2 === 1)
	.map((point) => {
		const corner = point.lengthSq() > 1;
		return { point: point.normalize(), weight: 4 * Math.PI * (corner ? 3 / 40 : 1 / 15) };
	});

/** State of a map's reading. */
interface Reading {
	/** Version of the map that was read last. */
	version: number;
	readonly harmonics: SphericalHarmonics3;
	/** Promise of the reading under way. */
	done: Promise<void> | undefined;
	failures: number;
}

const readings = new WeakMap<Texture, Reading>();

interface Pixels {
	width?: number;
	/** Picture of a cube's face that is a texture itself. */
	image?: Pixels;
}

const hasPixels = (image: Pixels | undefined): boolean => (image?.width ?? image?.image?.width ?? 0) > 0;

/** Whether all pictures of a map have been loaded. */
const isLoaded = ({ image }: Texture): boolean =>
	Array.isArray(image) ? image.length === 6 && image.every(hasPixels) : hasPixels(image as Pixels | undefined);

/** Harmonics of the radiance in the map's own axes. */
async function read(renderer: WebGLRenderer, map: Texture): Promise<SphericalHarmonics3> {
	const type = renderer.extensions.has('EXT_color_buffer_float') ? FloatType : HalfFloatType;
	const target = new WebGLCubeRenderTarget(SIZE, { type });
	const scene = new Scene();
	scene.background = map as CubeTexture;
	scene.backgroundBlurriness = BLUR;
	try {
		new CubeCamera(0.1, 10, target).update(renderer, scene);
		return (await LightProbeGenerator.fromCubeRenderTarget(renderer, target)).sh;
	} finally {
		target.dispose();
	}
}

/** Reading of a map; a new one is begun where it has been loaded or changed, behind the frame that is being drawn. */
function readingOf(renderer: WebGLRenderer, map: Texture): Reading {
	const reading = readings.get(map) ?? {
		version: Number.NaN,
		harmonics: new SphericalHarmonics3(),
		done: undefined,
		failures: 0,
	};
	readings.set(map, reading);
	const version = map.version + map.pmremVersion;
	if (reading.version === version || reading.done || !isLoaded(map)) return reading;
	reading.version = version;
	reading.done = Promise.resolve()
		.then(() => read(renderer, map))
		.then((harmonics) => {
			reading.harmonics.copy(harmonics);
			reading.failures = 0;
		})
		.catch((error) => {
			// A context that is lost comes back.
			if (++reading.failures < TRIES) reading.version = Number.NaN;
			else console.warn('furbake: scene.environment cannot be read, fur has no light of it:', error);
		})
		.finally(() => {
			reading.done = undefined;
		});
	return reading;
}

let probed = false;
const look = (object: Object3D): void => {
	probed ||= 'isLightProbe' in object;
};

/** Whether a scene has light probes, which count in place of its environment. */
function hasProbe(scene: Scene): boolean {
	probed = false;
	scene.traverseVisible(look);
	return probed;
}

/** Reads the scene's map, if it has been loaded. */
export async function prepare(renderer: WebGLRenderer, scene: Scene): Promise<void> {
	if (scene.environment && !hasProbe(scene)) await readingOf(renderer, scene.environment).done;
}

const turn = new Matrix4();
const from = new Vector3();
const radiance = new Vector3();
const basis = new Array<number>(9).fill(0);
const turned = new SphericalHarmonics3();

/** Harmonics of a scene's environment, turned as three turns it, times its intensity; 0 until it has been read. The result is reused. */
export function probeOf(renderer: WebGLRenderer, scene: Scene): Vector3[] {
	const { environment, environmentRotation, environmentIntensity } = scene;
	turned.zero();
	if (!environment || hasProbe(scene)) return turned.coefficients;
	const { harmonics } = readingOf(renderer, environment);
	turn.makeRotationFromEuler(environmentRotation).transpose();
	for (const { point, weight } of RULE) {
		harmonics.getAt(from.copy(point).applyMatrix4(turn), radiance);
		SphericalHarmonics3.getBasisAt(point, basis);
		for (let j = 0; j < 9; j++)
			(turned.coefficients[j] as Vector3).addScaledVector(
				radiance,
				environmentIntensity * weight * (basis[j] as number),
			);
	}
	return turned.coefficients;
}
