/** Step 2: hairs, the volume that they fill, and its slices, which can be pulled apart. */

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
import { bytesOf } from '../above.ts';
import { loadFurry } from '../assets.ts';
import { choice, controlRow, note, slider } from '../controls.ts';
import type { Mount } from '../lesson.ts';
import { FurPatch } from '../patch.ts';
import { hairTubes, loadStrands } from '../strands.ts';
import { View } from '../view.ts';

/** Coverage below which a voxel is left out: it would hide those behind it, which hold more. */
const SOLID = 0.35;
/** Heights of the fur that the slices fill when they are pulled apart. */
const APART = 3.6;
/** Share of the slider at first. */
const PULLED = 0.6;

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.slices;
	const [{ fur }, strands] = await Promise.all([loadFurry('pelt-paper', lesson), loadStrands()]);
	const { layers, size, height, coefficients, ramp } = fur.asset;

	const colours = { root: new Color(...ramp.root), tip: new Color(...ramp.tip), power: ramp.power };
	const hairs = new Mesh(hairTubes(strands, colours, height), new MeshStandardMaterial({ vertexColors: true }));
	const cubes = voxels(fur);
	const patch = new FurPatch(fur, 1);
	patch.shells.shellCount = layers;
	const frames = new Group();
	const square = new BufferGeometry().setFromPoints(
		[
			[-0.5, -0.5],
			[0.5, -0.5],
			[0.5, 0.5],
			[-0.5, 0.5],
		].map(([x, z]) => new Vector3(x, 0, z)),
	);
	const ink = new LineBasicMaterial({ color: 0xe9e4dc, transparent: true });
	frames.add(...Array.from({ length: layers }, () => new LineLoop(square, ink)));
	const all = new Group().add(hairs, cubes, patch, frames);

	const view = new View(place, lesson, {
		label: words.picture,
		aspect: 16 / 10,
		azimuth: 28,
		elevation: 24,
		zoom: 1.1,
		radius: 1.1,
	});
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
		// What is in one piece is shown as it is.
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

/** A cube for every voxel that hair fills, in its colour. */
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
