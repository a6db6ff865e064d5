import { BoxGeometry, Group, MathUtils, Mesh, SphereGeometry, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { facing } from '../../../web/measure/facing.ts';

const part = (name: string, size: [number, number, number], place: [number, number, number]) => {
	const mesh = new Mesh(new SphereGeometry(0.5, 24, 16));
	mesh.name = name;
	mesh.scale.set(...size);
	mesh.position.set(...place);
	return mesh;
};

/** An animal that looks along +z: a long body, a head above its front end, two ears. */
function animal(...eyes: Mesh[]): { root: Group; skin: Group } {
	const skin = new Group();
	skin.add(part('body', [0.8, 0.8, 2], [0, 0, 0]), part('head', [0.6, 0.6, 0.6], [0, 0.6, 1]));
	skin.add(part('ear left', [0.2, 0.4, 0.1], [0.2, 1, 1]), part('ear right', [0.2, 0.4, 0.1], [-0.2, 1, 1]));
	const root = new Group();
	root.add(skin, ...eyes);
	return { root, skin };
}

const eye = (name: string, x: number, z = 1.25) => part(name, [0.1, 0.1, 0.1], [x, 0.7, z]);

/** Where it is found to look, after a turn about the upright axis; degrees. */
function seen({ root, skin }: ReturnType<typeof animal>, turn: number): number {
	root.rotation.y = MathUtils.degToRad(turn);
	root.position.set(3, 1, -2);
	return MathUtils.radToDeg(facing(root, skin));
}

describe('facing', () => {
	it('is across the line between two eyes, by whatever names', () => {
		for (const names of [
			['eye left', 'eye right'],
			['LeftEye', 'RightEye'],
			['Eye.L', 'Eye.R'],
			['eye_l_01', 'eye_r_01'],
		] as const)
			for (const turn of [0, 30, 90, -120, 179])
				expect(seen(animal(eye(names[0], 0.18), eye(names[1], -0.18)), turn)).toBeCloseTo(turn, 4);
	});

	it('is that of the head, where it looks aside', () => {
		// Eyes on a head turned by 40 degrees about its own middle.
		const aside = [0.18, -0.18].map((x, i) => {
			const place = new Vector3(x, 0.7, 0.25).applyAxisAngle(new Vector3(0, 1, 0), MathUtils.degToRad(40));
			return part(`eye ${i}`, [0.1, 0.1, 0.1], [place.x, place.y, place.z + 1]);
		});
		expect(seen(animal(...aside), 0)).toBeCloseTo(40, 0);
	});

	it('is where a single eye is', () => {
		expect(Math.abs(seen(animal(eye('eye', 0)), 70) - 70)).toBeLessThan(1);
	});

	it('is along x, to the higher end, for a body without eyes that lies there', () => {
		for (const turn of [90, -90]) expect(seen(animal(), turn)).toBeCloseTo(turn, 6);
	});

	it('is +z where nothing tells, and for a body that lies along z', () => {
		expect(seen(animal(), 0)).toBe(0);
		expect(
			seen(animal(part('eyebrow', [0.3, 0.1, 0.1], [0.2, 0.8, 1.2]), part('keyed', [1, 1, 1], [2, 0, 0])), 0),
		).toBe(0);
		for (const geometry of [new SphereGeometry(), new BoxGeometry(1, 2, 3)]) {
			const mesh = new Mesh(geometry);
			const root = new Group();
			root.add(mesh);
			expect(facing(root, mesh)).toBe(0);
		}
		expect(facing(new Group(), new Group())).toBe(0);
	});
});
