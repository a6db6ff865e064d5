import {
	Group,
	type Intersection,
	Mesh,
	MeshBasicMaterial,
	PerspectiveCamera,
	SphereGeometry,
	Vector2,
	type Vector3,
} from 'three';
import { describe, expect, it } from 'vitest';
import { Gestures } from '../../../../web/demo/hands/gestures.ts';
import type { DragAction } from '../../../../web/demo/hands/tools.ts';
import type { Dynamics } from '../../../../web/demo/model/dynamics.ts';
import type { Looks } from '../../../../web/demo/model/looks.ts';
import type { Picture } from '../../../../web/demo/stage/picture.ts';

const camera = Object.assign(new PerspectiveCamera(40, 1), { orbit: [0, 0, 1] });
camera.position.z = 10;
camera.updateMatrixWorld();

/** Hands on a ball of radius 1, and what they do to it: the act, and how far from the middle of the picture. */
function hands(act: DragAction) {
	const done: [act: string, aside: number][] = [];
	const note = (name: string) => (at: Vector3) => void done.push([name, Math.round(10 * at.x) / 10]);
	const skin = new Mesh(new SphereGeometry(1, 64, 32), new MeshBasicMaterial());
	const restPoint = ({ point }: Intersection, target: Vector3) => target.copy(point);
	const fur = { skin, shells: { furLength: 0.1 }, restPoint };
	const dynamics = {
		...{ rain: note('rain'), mud: note('mud'), stroke: note('stroke') },
		...{ warmUp() {}, sway: { release() {}, pull: note('pull') } },
	};
	const stage = { scene: new Group(), bodyRadius: 1, centre: skin.position };
	const picture = {
		...{ camera, stage, guides: new Group(), canvas: { dataset: {} }, calm: true, request() {} },
		middle: (target: Vector2) => target.set(0, 0),
	};
	const gestures = new Gestures(
		picture as unknown as Picture,
		{ fur, body: fur } as unknown as Looks,
		dynamics as unknown as Dynamics,
	);
	gestures.act = act;
	return { gestures, done };
}

const [middle, right, beyond] = [0, 0.1, 0.9].map((x) => new Vector2(x, 0)) as [Vector2, Vector2, Vector2];

describe('a tap that is over before a frame', () => {
	it.each(['rain', 'mud'] as const)('is %s where it was', (act) => {
		const { gestures, done } = hands(act);
		gestures.press(true);
		gestures.point(right);
		gestures.press(false);
		gestures.point(undefined);
		gestures.step(0.02);
		expect(done).toEqual([[act, 0.3]]);
	});

	it('is nothing beside the body, and no stroke', () => {
		for (const [act, at] of [
			['rain', beyond],
			['stroke', middle],
		] as const) {
			const { gestures, done } = hands(act);
			gestures.press(true);
			gestures.point(at);
			gestures.press(false);
			expect(done, act).toEqual([]);
		}
	});

	it('does not count twice when a frame has seen it', () => {
		const { gestures, done } = hands('rain');
		gestures.press(true);
		gestures.point(middle);
		gestures.step(0.02);
		gestures.press(false);
		gestures.step(0.02);
		expect(done).toHaveLength(1);
	});
});

describe('a key', () => {
	it('works in the middle where there is no ring, and where a pointer has it', () => {
		const { gestures, done } = hands('rain');
		gestures.stroke();
		gestures.step(0.02);
		gestures.point(right);
		gestures.stroke();
		gestures.step(0.02);
		expect(done).toEqual([
			['rain', 0],
			['rain', 0.3],
		]);
	});
});
