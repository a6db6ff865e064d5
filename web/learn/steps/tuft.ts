/** The article's figure 3: a tuft of fur and the shadow that it casts on a plane. */

import {
	CircleGeometry,
	Color,
	DataTexture,
	Float32BufferAttribute,
	LinearFilter,
	Mesh,
	MeshBasicMaterial,
	MeshStandardMaterial,
	SRGBColorSpace,
	Vector3,
} from 'three';
import { loadFurry } from '../data/assets.ts';
import { hairTubes, loadStrands } from '../data/strands.ts';
import type { Mount } from '../lesson.ts';
import { FurPatch, tiled } from '../patch.ts';
import { View } from '../view.ts';

/** Radius of the tuft at its foot, tile widths; hairs thin out beyond `RIM`. */
const RADIUS = 0.46;
const RIM = 0.4;
/** Length of the tuft over the tile's own hairs. */
const LENGTH = 1.7;
const GROUND = 2.6;
const MAP_SIZE = 1024;

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.tuft;
	const [{ fur }, strands] = await Promise.all([loadFurry('pelt-paper', lesson), loadStrands()]);

	const surface = tiled(1, 24);
	const position = surface.getAttribute('position');
	const mask: number[] = [];
	for (let i = 0; i < position.count; i++) {
		const away = Math.hypot(position.getX(i), position.getZ(i));
		mask.push(smooth((RADIUS - away) / (RADIUS - RIM)), 1 - 0.6 * Math.min(away / RADIUS, 1) ** 2, 1, 0);
	}
	surface.setAttribute('_fur', new Float32BufferAttribute(mask, 4));
	const patch = new FurPatch(fur, 1, surface);
	patch.skin.visible = false;
	patch.shells.material.furLength *= LENGTH;

	// The shadow map is drawn from the volume's own hairs, invisible to the camera.
	const { root, tip, power } = fur.asset.ramp;
	const colours = { root: new Color(...root), tip: new Color(...tip), power };
	const inside = (x: number, z: number) => Math.hypot(x, z) < (RADIUS + RIM) / 2;
	const hairs = new Mesh(
		hairTubes(strands, colours, patch.height, { sides: 3, keep: inside }),
		new MeshBasicMaterial({ colorWrite: false, depthWrite: false }),
	);
	hairs.scale.y = LENGTH;
	hairs.castShadow = true;

	const ground = new Mesh(
		new CircleGeometry(GROUND, 64).rotateX(-Math.PI / 2),
		new MeshStandardMaterial({ color: 0x77716a, alphaMap: fading(), transparent: true, depthWrite: false }),
	);
	ground.receiveShadow = true;
	ground.renderOrder = -1;

	const view = new View(place, lesson, {
		label: words.picture,
		aspect: 16 / 9,
		azimuth: -14,
		elevation: 30,
		zoom: 1.1,
		centre: new Vector3(0, 0.28, 0),
		radius: 1,
	});
	view.add(ground, patch, hairs);
	view.cast(0.006, 1.6);
	view.key.shadow.mapSize.setScalar(MAP_SIZE);
	view.key.shadow.radius = 2.5;
	view.key.shadow.normalBias = 0;
};

function smooth(t: number): number {
	const x = Math.min(Math.max(t, 0), 1);
	return x * x * (3 - 2 * x);
}

/** Texture that is white in the middle and clear at the rim. */
function fading(size = 128): DataTexture {
	const texels = new Uint8Array(size * size * 4).fill(255);
	for (let y = 0; y < size; y++)
		for (let x = 0; x < size; x++) {
			const away = Math.hypot(x + 0.5 - size / 2, y + 0.5 - size / 2) / (size / 2);
			texels.fill(255 * smooth(1.15 * (1 - away)), (y * size + x) * 4, (y * size + x) * 4 + 3);
		}
	const map = new DataTexture(texels, size, size);
	map.colorSpace = SRGBColorSpace;
	map.magFilter = map.minFilter = LinearFilter;
	map.needsUpdate = true;
	return map;
}
