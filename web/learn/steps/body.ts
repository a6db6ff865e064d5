/** The fur on a body. Shells, fins, overlapping patches, and the hull that casts the shadow. */

import {
	BufferAttribute,
	BufferGeometry,
	Color,
	LineBasicMaterial,
	LineSegments,
	Vector3,
	WireframeGeometry,
} from 'three';
import type { FurShells } from '../../fur/index.ts';
import { GLOW } from '../../page/look.ts';
import { choice, controlRow, note } from '../controls.ts';
import { loadFurry, loadReport, reach } from '../data/assets.ts';
import { patchesOf } from '../data/patches.ts';
import type { Mount } from '../lesson.ts';
import { View } from '../view.ts';

const MODEL = 'bunny';
/** Height of the shadow's hull, share of the fur's length. */
const HULL = 0.75;

interface Report {
	asset: Record<'skin' | 'shells', { faces: number }>;
}

export const mount: Mount = async (place, lesson) => {
	const words = lesson.words.body;
	const [furry, report] = await Promise.all([loadFurry(MODEL, lesson), loadReport<Report>(MODEL)]);
	const { shells, fins, asset } = furry.fur;
	const view = new View(place, lesson, {
		label: words.picture,
		aspect: 16 / 10,
		azimuth: 16,
		elevation: 8,
		zoom: 1.12,
		...reach(furry),
	});
	view.add(furry.object);
	view.cast(asset.length, view.radius);
	shells.material.glow = GLOW * furry.fur.extent;

	const { of, count } = patchesOf(shells.geometry);
	const white = new BufferAttribute(new Float32Array(of.length * 3).fill(1), 3);
	const painted = white.clone();
	const paint = new Color();
	for (const [vertex, patch] of of.entries()) {
		// Consecutive patches get distant hues.
		paint.setHSL((patch * 0.618034) % 1, 0.62, 0.56).toArray(painted.array, vertex * 3);
	}
	const { root, tip, tip2 } = shells.material;
	const own = [root, tip, tip2].map((colour) => colour.clone());
	const plain = [0.1, 0.85, 0.85].map((grey) => new Color(grey, grey, grey));
	const hull = hullOf(shells);
	shells.parent?.add(hull);

	choice<keyof typeof words.parts>(controlRow(place), words.show, words.parts, 'fur', (part) => {
		shells.visible = part !== 'fins' && part !== 'hull';
		if (fins) fins.visible = part !== 'shells' && part !== 'hull';
		hull.visible = part === 'hull';
		const coloured = part === 'patches';
		shells.geometry.setAttribute('color', coloured ? painted : white);
		for (const [i, colour] of [root, tip, tip2].entries()) colour.copy((coloured ? plain : own)[i] as Color);
		view.redraw();
	});
	const faces = (shells.geometry.index?.count ?? 0) / 3;
	const line = note(place);
	line.textContent = words.numbers({
		skin: report.asset.skin.faces,
		patches: count,
		faces,
		overlap: faces / report.asset.skin.faces,
		fins: fins ? (fins.geometry.index?.count ?? 0) / 3 : 0,
	});
};

/** Shells' surface moved out to the hull, as lines. */
function hullOf(shells: FurShells): LineSegments {
	const surface = shells.geometry;
	const [position, normal, fur] = ['position', 'normal', '_fur'].map((name) => surface.getAttribute(name));
	// Floats, since stored positions are quantised within the skin's box.
	const moved = new BufferAttribute(new Float32Array(3 * (position?.count ?? 0)), 3);
	if (!position || !normal) throw new Error(`models/${MODEL}: its shells have no normals`);
	const [point, out] = [new Vector3(), new Vector3()];
	for (let i = 0; i < moved.count; i++) {
		out.fromBufferAttribute(normal, i).normalize();
		point.fromBufferAttribute(position, i).addScaledVector(out, shells.material.furLength * HULL * (fur?.getY(i) ?? 1));
		moved.setXYZ(i, point.x, point.y, point.z);
	}
	const geometry = new BufferGeometry().setAttribute('position', moved).setIndex(surface.index);
	const lines = new LineSegments(
		new WireframeGeometry(geometry),
		new LineBasicMaterial({ color: 0x9cc7ea, transparent: true, opacity: 0.5 }),
	);
	lines.position.copy(shells.position);
	lines.quaternion.copy(shells.quaternion);
	lines.scale.copy(shells.scale);
	lines.renderOrder = 1;
	return lines;
}
