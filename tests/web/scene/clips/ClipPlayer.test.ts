/** One clip at a time: played in a loop, held, faded into the next; and the room that the body needs meanwhile. */

import { Box3, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { ClipPlayer } from '../../../../web/scene/clips/ClipPlayer.ts';
import { limb } from './body.ts';

function player() {
	const body = limb();
	const clips = new ClipPlayer(body.object, [body.mesh], body.clips);
	/** Turn of the upper half, radians. */
	const bend = () => 2 * Math.asin(body.elbow.quaternion.z);
	return { ...body, clips, bend };
}

/** What three itself says of the box around a posed mesh. */
function boxOf({ mesh, object }: Pick<ReturnType<typeof limb>, 'mesh' | 'object'>): Box3 {
	object.updateMatrixWorld(true);
	const box = new Box3();
	const vertex = new Vector3();
	for (let i = 0; i < mesh.geometry.getAttribute('position').count; i++)
		box.expandByPoint(mesh.getVertexPosition(i, vertex).applyMatrix4(mesh.matrixWorld));
	return box;
}

const corners = ({ min, max }: Box3) => [...min.toArray(), ...max.toArray()];

describe('a clip', () => {
	it('is the first at first, and held until it is played', () => {
		const { clips, bend } = player();
		expect([clips.names, clips.name, clips.duration]).toEqual([['Bend', 'Leap', 'Swell'], 'Bend', 2]);
		expect(clips.step(1)).toBe(true);
		expect([clips.time, bend(), clips.playing]).toEqual([0, 0, false]);
		expect(clips.step(1)).toBe(false);
	});

	it('plays in a loop, at its speed', () => {
		const { clips, bend } = player();
		clips.play();
		clips.step(0.5);
		expect(bend()).toBeCloseTo(Math.PI / 4, 6);
		clips.speed = 0.5;
		clips.step(1);
		expect(clips.time).toBeCloseTo(1);
		clips.speed = 2;
		clips.step(0.75);
		expect(clips.time).toBeCloseTo(0.5);
		expect(clips.step(0)).toBe(false);
	});

	it('is held at any time: the pose of it, at once, and nothing more', () => {
		const { clips, bend } = player();
		for (const [time, angle] of [
			[1, Math.PI / 2],
			[0.5, Math.PI / 4],
			[7, 0],
		] as const) {
			clips.hold(time);
			expect(clips.step(0.1)).toBe(true);
			expect(bend()).toBeCloseTo(angle, 6);
			expect(clips.time).toBe(Math.min(time, 2));
			expect(clips.step(0.1)).toBe(false);
		}
		clips.play();
		clips.step(0.25);
		expect(clips.time).toBeCloseTo(0.25);
	});

	it('shows moments of its loop for a crowd, evenly spread from the present one, and comes back', () => {
		const { clips, bend } = player();
		clips.hold(0.5);
		clips.step(0);
		const seen = new Map<number, number>();
		clips.eachPhase(4, (phase) => seen.set(phase, bend()));
		// Bent by a quarter turn in a second, and back in the next.
		for (const [phase, angle] of [Math.PI / 4, Math.PI / 2, Math.PI / 4, 0].entries())
			expect(seen.get(phase)).toBeCloseTo(angle, 6);
		expect([clips.time, clips.playing]).toEqual([0.5, false]);
		expect(bend()).toBeCloseTo(Math.PI / 4, 6);
	});

	it('fades into the next in 0.3 s while it plays, without a jump', () => {
		const { clips, bend, root } = player();
		clips.play();
		clips.step(1);
		clips.choose('Leap');
		let [angle, height] = [bend(), root.position.y];
		for (let step = 0; step < 30; step++) {
			clips.step(0.01);
			expect(Math.abs(bend() - angle)).toBeLessThan(0.12);
			expect(Math.abs(root.position.y - height)).toBeLessThan(0.12);
			[angle, height] = [bend(), root.position.y];
		}
		clips.step(0.01);
		expect(bend()).toBeCloseTo(0, 6);
		expect(root.position.y).toBeCloseTo(6 * 0.31, 5);
	});

	it('is another at once where it is held', () => {
		const { clips, bend, root } = player();
		clips.hold(1);
		clips.step(0);
		clips.choose('Leap');
		clips.hold(0.5);
		clips.step(0);
		expect([bend(), root.position.y]).toEqual([0, 3]);
		clips.choose('Nothing');
		expect(clips.name).toBe('Leap');
	});
});

describe('the room of a body', () => {
	it.each([
		['Bend', [0, 0.4, 1, 1.7]],
		['Leap', [0, 0.25, 0.8]],
		['Swell', [0, 0.5, 1]],
	])('in %s is what three says of each pose, within a fiftieth of its height', (name, times) => {
		const body = player();
		const { clips } = body;
		clips.choose(name);
		for (const time of times) {
			clips.hold(time);
			clips.step(0);
			const [told, whole] = [corners(clips.poseBox(new Box3())), corners(boxOf(body))];
			for (const [i, value] of told.entries())
				expect(Math.abs(value - (whole[i] as number)), `${time}: ${i}`).toBeLessThan(0.04);
			expect(clips.box.clone().expandByScalar(0.04).containsBox(boxOf(body))).toBe(true);
		}
	});

	it('holds all of the clip in its radius', () => {
		const body = player();
		for (const name of body.clips.names) {
			body.clips.choose(name);
			for (let time = 0; time < 2; time += 0.1) {
				body.clips.hold(time);
				body.clips.step(0);
				const centre = body.clips.box.getCenter(new Vector3());
				const vertex = new Vector3();
				for (let i = 0; i < body.mesh.geometry.getAttribute('position').count; i++) {
					body.mesh.getVertexPosition(i, vertex);
					expect(vertex.distanceTo(centre)).toBeLessThan(1.02 * body.clips.radius);
				}
			}
		}
	});

	it('is the new clip’s after a fade, and between both on the way', () => {
		const { clips } = player();
		clips.play();
		clips.step(0.1);
		const low = clips.box.max.y;
		clips.choose('Leap');
		clips.step(0.15);
		const between = clips.box.max.y;
		clips.step(0.2);
		expect(clips.box.max.y).toBeCloseTo(5, 1);
		expect(between).toBeCloseTo((low + clips.box.max.y) / 2, 5);
		expect(clips.faded(({ low: [first] }) => first?.height ?? 9)).toBeCloseTo(0, 6);
	});

	it('leaves the body as it was in the file', () => {
		const { mesh, elbow, root, clips } = player();
		clips.dispose();
		expect(elbow.quaternion.toArray()).toEqual([0, 0, 0, 1]);
		expect(root.position.toArray()).toEqual([0, 0, 0]);
		expect(mesh.morphTargetInfluences).toEqual([0]);
	});
});

describe('the room of a clip', () => {
	const made = (rest?: { box: Box3; radius: number }) => {
		const body = limb();
		return new ClipPlayer(body.object, [body.mesh], body.clips, rest);
	};

	it('is that of the body at rest where the clip hardly leaves it', () => {
		const own = made();
		const aside = (share: number) => {
			const box = own.box.clone();
			box.max.x += share * own.radius;
			return { box, radius: 1.01 * own.radius };
		};
		const kept = made(aside(0.03));
		expect([...corners(kept.box), kept.radius]).toEqual([...corners(aside(0.03).box), aside(0.03).radius]);
		const left = made(aside(0.2));
		expect([...corners(left.box), left.radius]).toEqual([...corners(own.box), own.radius]);
	});
});
