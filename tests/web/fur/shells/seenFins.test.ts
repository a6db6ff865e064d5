import {
	Bone,
	BufferAttribute,
	BufferGeometry,
	Float32BufferAttribute,
	MathUtils,
	Matrix3,
	Matrix4,
	OrthographicCamera,
	PerspectiveCamera,
	Quaternion,
	Skeleton,
	SkinnedMesh,
	Uint16BufferAttribute,
	Vector3,
} from 'three';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { SeenFins } from '../../../../web/fur/shells/fins/SeenFins.ts';

const FINS = 400;
const FADE = 0.15;
const BROADSIDE = 0.15;

/** Numbers in 0..1 that are the same in every run. */
function seeded(seed: number): () => number {
	MathUtils.seededRandom(seed);
	return () => MathUtils.seededRandom();
}

type Weights = readonly (readonly [joint: number, weight: number])[];

/** Fins anyhow in a cube, of one strip; each end of an edge has up to two joints of five. */
function fins(): { geometry: BufferGeometry; weights: Weights[] } {
	const random = seeded(7);
	const any = () => new Vector3(random() - 0.5, random() - 0.5, random() - 0.5);
	const [position, normal, tangent, edge, index, joints, shares]: number[][] = [[], [], [], [], [], [], []];
	const weights: Weights[] = [];
	for (let fin = 0; fin < FINS; fin++) {
		const place = any();
		const n = any().normalize();
		const along = any().cross(n).normalize();
		const [a, b] = [random() - 0.5, random() - 0.5];
		const ends = [0, 1].map(() => {
			const share = random() < 0.5 ? 1 : random();
			return [
				[Math.floor(random() * 5), share],
				[Math.floor(random() * 5), 1 - share],
			] as const;
		});
		for (let vertex = 0; vertex < 4; vertex++) {
			position?.push(...place.toArray());
			normal?.push(...n.toArray());
			tangent?.push(...along.toArray(), 1);
			edge?.push(a * 0.6, b * 0.6, 0, 0);
			const [first, second] = ends[vertex % 2] as [Weights[number], Weights[number]];
			joints?.push(first[0], second[0], 0, 0);
			shares?.push(first[1], second[1], 0, 0);
			weights.push([first, second]);
		}
		index?.push(...[0, 1, 3, 0, 3, 2].map((corner) => 4 * fin + corner));
	}
	const geometry = new BufferGeometry()
		.setAttribute('position', new Float32BufferAttribute(position as number[], 3))
		.setAttribute('normal', new Float32BufferAttribute(normal as number[], 3))
		.setAttribute('tangent', new Float32BufferAttribute(tangent as number[], 4))
		.setAttribute('_edge', new Float32BufferAttribute(edge as number[], 4))
		.setAttribute('skinIndex', new Uint16BufferAttribute(joints as number[], 4))
		.setAttribute('skinWeight', new Float32BufferAttribute(shares as number[], 4))
		.setIndex(new BufferAttribute(Uint16Array.from(index as number[]), 1));
	return { geometry, weights };
}

/** A mesh of these fins, whose joints have turned by up to `angle`, and one grown along an axis. */
function posed(geometry: BufferGeometry, angle: number, stretch = 1): SkinnedMesh {
	const random = seeded(11);
	const mesh = new SkinnedMesh(geometry);
	const bones = Array.from({ length: 5 }, () => new Bone());
	mesh.add(...bones);
	mesh.position.set(3, 1, -2);
	mesh.rotation.set(0.4, 1, -0.3);
	mesh.scale.setScalar(2);
	mesh.updateMatrixWorld(true);
	mesh.bind(new Skeleton(bones));
	for (const bone of bones) {
		const axis = new Vector3(random() - 0.5, random() - 0.5, random() - 0.5).normalize();
		bone.quaternion.setFromAxisAngle(axis, angle * random());
		bone.position.set(0.1 * random(), 0, 0);
	}
	bones[2]?.scale.set(1, stretch, 1);
	mesh.updateMatrixWorld(true);
	mesh.skeleton.update();
	return mesh;
}

/** The oracle: the fade of fins.vert.glsl at a vertex, from its joints' matrices. */
function fade(mesh: SkinnedMesh, weights: Weights, vertex: number, eye: Vector3): number {
	const sum = new Matrix4().makeScale(0, 0, 0);
	sum.elements[15] = 0;
	for (const [joint, weight] of weights) {
		const matrix = new Matrix4().fromArray(mesh.skeleton.boneMatrices as Float32Array, 16 * joint);
		matrix.elements.forEach((value, i) => {
			sum.elements[i] = (sum.elements[i] as number) + weight * value;
		});
	}
	const whole = mesh.matrixWorld
		.clone()
		.multiply(mesh.bindMatrixInverse.clone().multiply(sum).multiply(mesh.bindMatrix));
	const of = (name: string) => new Vector3().fromBufferAttribute(mesh.geometry.getAttribute(name), vertex);
	const across = new Matrix3().getNormalMatrix(whole);
	const viewer = eye.clone().sub(of('position').applyMatrix4(whole)).normalize();
	const restAcross = of('tangent').cross(of('normal')).normalize();
	const upright = restAcross.clone().cross(of('tangent'));
	const [one, other] = [0, 1].map((face) => {
		const angle = Math.PI * mesh.geometry.getAttribute('_edge').getComponent(vertex, face);
		const n = upright.clone().multiplyScalar(Math.cos(angle)).addScaledVector(restAcross, Math.sin(angle));
		return n.applyMatrix3(across).normalize().dot(viewer);
	}) as [number, number];
	const edge = of('tangent').transformDirection(whole);
	const normal = of('normal').applyMatrix3(across).normalize();
	const broadside = Math.abs(edge.cross(normal).normalize().dot(viewer));
	const off = one * other > 0 ? Math.min(Math.abs(one), Math.abs(other)) : 0;
	return broadside <= BROADSIDE || off >= FADE ? 0 : 1;
}

describe('SeenFins of a body with joints', () => {
	let now = 0;
	beforeEach(() => {
		now = 0;
		vi.spyOn(performance, 'now').mockImplementation(() => now);
	});
	afterEach(() => vi.restoreAllMocks());

	const camera = new PerspectiveCamera();
	camera.position.set(1, 4, 3);
	camera.updateMatrixWorld();

	it.each([
		[0.2, 1],
		[0.6, 1],
		[1.2, 1],
		[0.3, 1.15],
		[0.3, 2],
	])(
		'has all fins that are seen with joints turned by %s and one grown %s times, and not many more',
		(angle, stretch) => {
			const { geometry, weights } = fins();
			const mesh = posed(geometry, angle, stretch);
			const chosen = new SeenFins().choose(mesh, camera, 1, FADE);
			const drawn = new Set<number>();
			for (let i = 0; i < (chosen?.count ?? 0); i++) drawn.add(Math.floor((chosen?.index.array[i] as number) / 4));
			let seen = 0;
			for (let fin = 0; fin < FINS; fin++) {
				const shows = [0, 1, 2, 3].some((end) =>
					fade(mesh, weights[4 * fin + end] as Weights, 4 * fin + end, camera.position),
				);
				if (shows) seen++;
				if (shows) expect(drawn, `fin ${fin}`).toContain(fin);
			}
			expect(seen).toBeGreaterThan(FINS / 10);
			expect(drawn.size).toBeLessThan(FINS * 0.75);
			expect(drawn.size).toBeLessThan((stretch > 1.2 ? 2.2 : 1.7) * seen);
		},
	);

	it('follows a camera without a place, too', () => {
		const { geometry, weights } = fins();
		const mesh = posed(geometry, 0.5);
		const flat = new OrthographicCamera();
		flat.quaternion.copy(new Quaternion().setFromAxisAngle(new Vector3(0.6, 0.8, 0), 1));
		flat.updateMatrixWorld();
		const far = new Vector3(0, 0, 1e6).applyQuaternion(flat.quaternion);
		const chosen = new SeenFins().choose(mesh, flat, 1, FADE);
		const drawn = new Set(
			Array.from({ length: chosen?.count ?? 0 }, (_, i) => (chosen?.index.array[i] as number) >> 2),
		);
		for (let fin = 0; fin < FINS; fin++)
			if ([0, 1, 2, 3].some((end) => fade(mesh, weights[4 * fin + end] as Weights, 4 * fin + end, far)))
				expect(drawn).toContain(fin);
	});

	it('chooses while it moves only where that takes little of a frame, and once more where it stops', () => {
		const mesh = posed(fins().geometry, 0.5);
		const seen = new SeenFins();
		const turn = () => {
			for (const bone of mesh.skeleton.bones) bone.rotation.x += 0.1;
			mesh.updateMatrixWorld(true);
			mesh.skeleton.update();
		};
		const choose = (after: number) => {
			now += after;
			return seen.choose(mesh, camera, 1, FADE)?.count;
		};
		const first = choose(0);
		expect(first).toBeGreaterThan(0);
		// A clock that goes on by a millisecond whenever it is read: a choice takes one.
		vi.mocked(performance.now).mockImplementation(() => now++);
		turn();
		expect(choose(1000)).toBeGreaterThan(0);
		turn();
		expect(choose(3)).toBeUndefined();
		turn();
		expect(choose(3)).toBeUndefined();
		expect(choose(3)).toBeGreaterThan(0);
		turn();
		expect(choose(100)).toBeGreaterThan(0);
	});

	it('goes on choosing where frames are short because it chooses, and again after one choice that took long', () => {
		const mesh = posed(fins().geometry, 0.5);
		const seen = new SeenFins();
		let took = 3;
		vi.mocked(performance.now).mockImplementation(() => now);
		const index = vi.spyOn(BufferAttribute.prototype, 'clearUpdateRanges').mockImplementation(function (
			this: BufferAttribute,
		) {
			now += took;
			return this;
		});
		let chosen = true;
		const frame = () => {
			for (const bone of mesh.skeleton.bones) bone.rotation.x += 0.1;
			mesh.updateMatrixWorld(true);
			mesh.skeleton.update();
			now += chosen ? 50 : 130;
			chosen = seen.choose(mesh, camera, 1, FADE) !== undefined;
			return chosen;
		};
		const frames = (count: number) => Array.from({ length: count }, frame);
		frames(2);
		expect(frames(20)).not.toContain(false);
		took = 20;
		frame();
		took = 3;
		expect(frames(60).slice(-10)).not.toContain(false);
		index.mockRestore();
	});
});
