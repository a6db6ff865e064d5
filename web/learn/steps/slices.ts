/** Hairs, their volume, and its slices, which can be pulled apart. */

import {
	BoxGeometry,
	BufferGeometry,
	Color,
	Group,
	InstancedMesh,
	LineBasicMaterial,
	LineLoop,
	Matrix4,
	Mesh,
	MeshStandardMaterial,
	SRGBColorSpace,
	Vector3,
} from 'three';
import type { Fur } from '../../fur/index.ts';
import { choice, controlRow, note, slider } from '../controls.ts';
import { bytesOf } from '../data/above.ts';
import { loadFurry } from '../data/assets.ts';
import { hairTubes, loadStrands } from '../data/strands.ts';
import type { Mount } from '../lesson.ts';
import { FurPatch } from '../patch.ts';
import { View } from '../view.ts';

/** Coverage below which a voxel is left out, since it would hide denser ones behind. */
const SOLID = 0.35;
/** Height of the slices pulled apart, heights of the fur. */
const APART = 3.6;
/** First share of the slider. */
const PULLED = 0.6;
/** Where the picture is taken from. */
const SEEN = { aspect: 16 / 10, azimuth: 28, elevation: 24, zoom: 1.1, radius: 1.1 };

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.slices;
	const [{ fur }, strands] = await Promise.all([loadFurry('pelt-paper', lesson), loadStrands()]);
	const { layers, size, height, coefficients, ramp } = fur.asset;

	const colours = { root: new Color(...ramp.root), tip: new Color(...ramp.tip), power: ramp.power };
	const hairs = new Mesh(hairTubes(strands, colours, height), new MeshStandardMaterial({ vertexColors: true }));
	const cubes = voxels(fur);
	const patch = new FurPatch(fur, 1);
	patch.shells.shellCount = layers;
	const ink = new LineBasicMaterial({ color: 0xe9e4dc, transparent: true });
	const frames = outlines(layers, ink);
	const all = new Group().add(hairs, cubes, patch, frames);

	const view = new View(place, lesson, { label: words.picture, ...SEEN });
	view.add(all);
	for (const solid of [hairs, cubes]) solid.castShadow = solid.receiveShadow = true;
	view.cast(0.012, 0.9);

	const pull = (share: number) => {
		const tall = height * (1 + (APART - 1) * share);
		patch.shells.material.furLength = tall;
		for (const [k, frame] of frames.children.entries()) frame.position.y = ((k + 0.5) / layers) * tall;
		ink.opacity = 0.4 * share;
		patch.skin.visible = share < 0.5;
		all.position.y = -tall / 2;
		view.redraw();
	};

	const row = controlRow(place);
	const apart = slider(row, {
		label: words.apart,
		min: 0,
		max: 1,
		step: 0.01,
		value: PULLED,
		text: (share) => words.times(1 + (APART - 1) * share),
		input: pull,
	});
	const line = note(place);
	let pulled = PULLED;
	const shown = { strands: hairs, volume: cubes, slices: patch };
	const stages = choice(row, words.stage, words.stages, 'slices', (stage) => {
		for (const [name, object] of Object.entries(shown)) object.visible = name === stage;
		frames.visible = stage === 'slices';
		// Views without slices are never pulled apart.
		if (!apart.element.disabled) pulled = apart.value;
		apart.element.disabled = stage !== 'slices';
		apart.value = stage === 'slices' ? pulled : 0;
		line.textContent = {
			strands: words.strands(strands.count),
			volume: words.volume(size, layers, cubes.count, SOLID),
			slices: words.slices(layers, size, coefficients),
		}[stage];
	});
	row.prepend(stages);
};

/** Square around every slice. */
function outlines(layers: number, ink: LineBasicMaterial): Group {
	const square = new BufferGeometry().setFromPoints(
		[
			[-0.5, -0.5],
			[0.5, -0.5],
			[0.5, 0.5],
			[-0.5, 0.5],
		].map(([x, z]) => new Vector3(x, 0, z)),
	);
	return new Group().add(...Array.from({ length: layers }, () => new LineLoop(square, ink)));
}

/** Cube for every voxel with hair, in its colour. */
function voxels(fur: Fur): InstancedMesh {
	const { layers, size, height, ramp } = fur.asset;
	const alpha = bytesOf(fur.textures.plane1);
	const colour = bytesOf(fur.textures.colour);
	const solid: number[] = [];
	for (let i = 0; i < layers * size * size; i++) if ((alpha[4 * i + 2] ?? 0) > 255 * SOLID) solid.push(i);
	const mesh = new InstancedMesh(
		new BoxGeometry(1 / size, height / layers, 1 / size),
		new MeshStandardMaterial(),
		solid.length,
	);
	const [place, paint] = [new Matrix4(), new Color()];
	const [root, tip] = [new Color(...ramp.root), new Color(...ramp.tip)];
	for (const [n, i] of solid.entries()) {
		const [c, r, k] = [i % size, Math.floor(i / size) % size, Math.floor(i / (size * size))];
		const y = ((k + 0.5) / layers) * height;
		mesh.setMatrixAt(n, place.makeTranslation((c + 0.5) / size - 0.5, y, 0.5 - (r + 0.5) / size));
		const [red = 0, green = 0, blue = 0] = colour.subarray(4 * i, 4 * i + 3);
		if (colour.length) paint.setRGB(red / 255, green / 255, blue / 255, SRGBColorSpace);
		else paint.lerpColors(root, tip, (y / height) ** ramp.power);
		mesh.setColorAt(n, paint);
	}
	return mesh;
}
