/** Pictures of a whole model from its four sides in the pages' daylight, for `furbake report`. */

import { Color, DirectionalLight, Vector3, WebGLRenderer } from 'three';
import { fitFurShadow } from '../fur/index.ts';
import { daylightSky, KEY_COLOUR } from '../page/daylight.ts';
import { DEFAULT_LOOK } from '../page/look.ts';
import { setToneMapping } from '../page/toneMapping.ts';
import { facing } from './facing.ts';
import { loadFur, Studio } from './studio.ts';

/** Azimuth of each side, radians from the front to the model's left. */
export const SIDES = { front: 0, left: Math.PI / 2, back: Math.PI, right: -Math.PI / 2 } as const;

/** Height of the eye, radians from straight above. */
const POLAR = 1.4;

/** Distance of the eye over that at which the model's sphere fits with room around it. */
const DISTANCE = 0.85;

/** Direction of the lamp seen from each eye: right, up, to the viewer. */
const LAMP = new Vector3(-0.55, 0.6, 0.58);

/** Samples per pixel and axis. */
const SAMPLES = 2;

/**
 * Pictures as JPEG data addresses, by side.
 *
 * @param url of an asset's model.gltf
 * @param size of each picture, pixels
 * @param backdrop colour behind the model, CSS
 */
export async function drawSides(url: string, size: number, backdrop: string): Promise<Record<string, string>> {
	const fur = await loadFur(url);
	const renderer = new WebGLRenderer({ preserveDrawingBuffer: true });
	setToneMapping(renderer);
	renderer.shadowMap.enabled = true;
	renderer.setSize(size * SAMPLES, size * SAMPLES);
	renderer.setClearColor(new Color(backdrop));
	const studio = new Studio(renderer, fur, size, size);
	const key = new DirectionalLight(KEY_COLOUR, 1);
	studio.light(key, daylightSky());
	Object.assign(fur.material, DEFAULT_LOOK);
	const { bounds } = studio;
	const front = facing(fur.skin.parent ?? fur.skin, fur.skin);
	const found: Record<string, string> = {};
	for (const [side, azimuth] of Object.entries(SIDES)) {
		studio.look(front + azimuth, POLAR, DISTANCE);
		key.position.copy(studio.fromEye(LAMP).multiplyScalar(4 * bounds.radius)).add(bounds.center);
		fitFurShadow(key, bounds, fur.asset.length);
		key.target.updateMatrixWorld();
		studio.show();
		found[side] = halved(renderer.domElement, size);
	}
	studio.dispose();
	renderer.dispose();
	return found;
}

/** Picture at its final size, as JPEG. */
function halved(canvas: HTMLCanvasElement, size: number): string {
	const small = document.createElement('canvas');
	small.width = small.height = size;
	const context = small.getContext('2d') as CanvasRenderingContext2D;
	context.imageSmoothingQuality = 'high';
	context.drawImage(canvas, 0, 0, size, size);
	return small.toDataURL('image/jpeg', 0.9);
}
