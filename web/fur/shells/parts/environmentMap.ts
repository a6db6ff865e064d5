/** `scene.environment` as spherical harmonics of order 2, which light fur as those of a light probe do. */

import {
	CubeCamera,
	type CubeTexture,
	type Euler,
	FloatType,
	HalfFloatType,
	Matrix4,
	Scene,
	type ShaderMaterial,
	SphericalHarmonics3,
	type Texture,
	Vector3,
	WebGLCubeRenderTarget,
	type WebGLRenderer,
} from 'three';
import { LightProbeGenerator } from 'three/addons/lights/LightProbeGenerator.js';
import { switchPart } from '../switches.ts';

/** Pixels along the face of the cube in which a map is read. */
const SIZE = 64;
/** Roughness of three's blurred copy of the map that is read: a sun would fall between the pixels of a sharper one. */
const BLUR = 0.1;

/** Points and weights whose sums are integrals over the sphere up to degree 5: faces and corners of a cube. */
const RULE = [-1, 0, 1]
	.flatMap((x) => [-1, 0, 1].flatMap((y) => [-1, 0, 1].map((z) => new Vector3(x, y, z))))
	.filter((point) => point.manhattanLength() % 2 === 1)
	.map((point) => {
		const corner = point.lengthSq() > 1;
		return { point: point.normalize(), weight: 4 * Math.PI * (corner ? 3 / 40 : 1 / 15) };
	});

/** What is known of a map. */
interface Reading {
	/** of the map that is being read, or was */
	version: number;
	harmonics?: SphericalHarmonics3;
	done: Promise<void>;
}

const readings = new WeakMap<Texture, Reading>();

const there = (image: { width?: number; image?: { width?: number } } | undefined): boolean =>
	((image?.width ?? image?.image?.width) as number) > 0;

/** Whether all pictures of a map have been loaded. */
const isLoaded = ({ image }: Texture): boolean =>
	Array.isArray(image) ? image.length === 6 && image.every(there) : there(image as Parameters<typeof there>[0]);

/** Harmonics of the radiance in the map's own axes. Draws, and so not to be called while a picture is drawn. */
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

/** Reading of a map as it is now, begun if need be; undefined while the map itself is loaded. */
function readingOf(renderer: WebGLRenderer, map: Texture): Reading | undefined {
	const reading = readings.get(map);
	const version = map.version + map.pmremVersion;
	if (reading?.version === version || !isLoaded(map)) return reading;
	const next: Reading = { ...reading, version, done: Promise.resolve() };
	next.done = next.done.then(async () => {
		next.harmonics = await read(renderer, map);
	});
	readings.set(map, next);
	return next;
}

/** Reads a map, if it has been loaded. */
export async function prepare(renderer: WebGLRenderer, map: Texture): Promise<void> {
	await readingOf(renderer, map)?.done;
}

const turn = new Matrix4();
const from = new Vector3();
const radiance = new Vector3();
const basis = new Array<number>(9).fill(0);
const turned = new SphericalHarmonics3();

/** Harmonics, turned as three turns the map of a scene, times its intensity; the result is reused. */
function placed(harmonics: SphericalHarmonics3, rotation: Euler, intensity: number): Vector3[] {
	turn.makeRotationFromEuler(rotation).transpose();
	turned.zero();
	for (const { point, weight } of RULE) {
		harmonics.getAt(from.copy(point).applyMatrix4(turn), radiance);
		SphericalHarmonics3.getBasisAt(point, basis);
		for (let j = 0; j < 9; j++)
			(turned.coefficients[j] as Vector3).addScaledVector(radiance, intensity * weight * (basis[j] as number));
	}
	return turned.coefficients;
}

/** Light a material by the scene's map, once that has been read. */
export function follow(material: ShaderMaterial, renderer: WebGLRenderer, scene: Scene): void {
	const { environment, environmentRotation, environmentIntensity } = scene;
	const harmonics = environment ? readingOf(renderer, environment)?.harmonics : undefined;
	const { environmentProbe } = material.uniforms;
	if (harmonics && environmentProbe)
		environmentProbe.value = placed(harmonics, environmentRotation, environmentIntensity);
	switchPart(material, 'ENVIRONMENT_MAP', harmonics && '');
}
