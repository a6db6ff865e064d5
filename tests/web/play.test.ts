import { Group, Mesh, MeshBasicMaterial, PerspectiveCamera, SphereGeometry, Vector2, type Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import type { Living } from '../../web/demo/living.ts';
import type { Looks } from '../../web/demo/looks.ts';
import type { Picture } from '../../web/demo/picture.ts';
import { Play } from '../../web/demo/play.ts';
import type { Act } from '../../web/demo/tools.ts';

const camera = Object.assign(new PerspectiveCamera(40, 1), { orbit: [0, 0, 1] });
camera.position.z = 10;
camera.updateMatrixWorld();

/** Hands on a ball of radius 1, and what they do to it: the act, and how far from the middle of the picture. */
function hands(act: Act) {
	const done: [act: string, aside: number][] = [];
	const note = (name: string) => (at: Vector3) => void done.push([name, Math.round(10 * at.x) / 10]);
	const skin = new Mesh(new SphereGeometry(1, 64, 32), new MeshBasicMaterial());
	const fur = { skin, shells: { furLength: 0.1 } };
	const living = {
		...{ rain: note('rain'), mud: note('mud'), stroke: note('stroke') },
		...{ rehearse() {}, step: () => Number.POSITIVE_INFINITY, sway: { release() {}, pull: note('pull') } },
	};
	const stage = { scene: new Group(), closest: 1, centre: skin.position };
	const picture = { camera, stage, guides: new Group(), canvas: { dataset: {} }, calm: true, request() {} };
	const play = new Play(
		picture as unknown as Picture,
		{ fur, body: fur } as unknown as Looks,
		living as unknown as Living,
	);
	play.act = act;
	return { play, done };
}

const [middle, right, beyond] = [0, 0.1, 0.9].map((x) => new Vector2(x, 0)) as [Vector2, Vector2, Vector2];

describe('a tap that is over before a frame', () => {
	it.each(['rain', 'mud'] as const)('is %s where it was', (act) => {
		const { play, done } = hands(act);
		play.press(true);
		play.point(right);
		play.press(false);
		play.point(undefined);
		play.step(0.02);
		expect(done).toEqual([[act, 0.3]]);
	});

	it('is nothing beside the body, and no stroke', () => {
		for (const [act, at] of [
			['rain', beyond],
			['stroke', middle],
		] as const) {
			const { play, done } = hands(act);
			play.press(true);
			play.point(at);
			play.press(false);
			expect(done, act).toEqual([]);
		}
	});

	it('does not count twice when a frame has seen it', () => {
		const { play, done } = hands('rain');
		play.press(true);
		play.point(middle);
		play.step(0.02);
		play.press(false);
		play.step(0.02);
		expect(done).toHaveLength(1);
	});
});

describe('a key', () => {
	it('works in the middle where there is no ring, and where a pointer has it', () => {
		const { play, done } = hands('rain');
		play.stroke();
		play.step(0.02);
		play.point(right);
		play.stroke();
		play.step(0.02);
		expect(done).toEqual([
			['rain', 0],
			['rain', 0.3],
		]);
	});
});
