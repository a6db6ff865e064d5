import {
	BufferAttribute,
	BufferGeometry,
	Color,
	Mesh,
	MeshPhysicalMaterial,
	MeshStandardMaterial,
	ShaderLib,
	type WebGLProgramParametersWithUniforms,
} from 'three';
import { describe, expect, it } from 'vitest';
import { FurFollicles } from '../../../../web/fur/body/FurFollicles.ts';
import { furCover, standsOn } from '../../../../web/fur/body/skin/furCover.ts';
import { MatteMaterial } from '../../../../web/fur/body/skin/MatteMaterial.ts';
import { ShadedPiece, Skin } from '../../../../web/fur/body/skin/Skin.ts';
import type { FurAsset, RGB } from '../../../../web/fur/format.ts';

const attribute = (size: number, values: number[][]) => new BufferAttribute(new Float32Array(values.flat()), size);
const points = (...xs: number[]) =>
	new BufferGeometry().setAttribute(
		'position',
		attribute(
			3,
			xs.map((x) => [x, 0, 0]),
		),
	);
const shells = (...vertices: { x: number; weight?: number; length?: number }[]) =>
	points(...vertices.map(({ x }) => x)).setAttribute(
		'_fur',
		attribute(
			4,
			vertices.map(({ weight = 1, length = 1 }) => [weight, length, 1, 0]),
		),
	);

describe('furCover', () => {
	it('adds up the copies of a vertex; what no shell stands on is bare', () => {
		const fur = shells({ x: 0, weight: 0.25 }, { x: 0, weight: 0.75 }, { x: 1, weight: 0.5 }, { x: 2, length: 0 });
		expect([...(furCover(points(0, 1, 2, 3), fur) ?? [])]).toEqual([1, 0.5, 0, 0]);
	});

	it('is nothing to speak of where fur is all over, or stands on another surface', () => {
		expect(furCover(points(0, 1), shells({ x: 0 }, { x: 1, length: 0.5 }))).toBeUndefined();
		expect(furCover(points(0, 1), points(1, 0))).toBeUndefined();
		expect(furCover(points(0, 1), shells({ x: 0.5 }))).toBeUndefined();
	});

	it('is that of the nearest shells where these stand on a simpler surface, and none far from them', () => {
		const fur = shells({ x: 0 }, { x: 1 }, { x: 2.5, length: 0 }, { x: 3.5 });
		expect(standsOn([points(0, 1), points(2.5, 3.5, 9)], fur)).toBe(true);
		expect(standsOn([points(0, 0.4, 0.9, 2.2, 30)], fur)).toBe(false);
		// Its one edge is 1 long.
		expect([...(furCover(points(0, 0.4, 0.9, 2.2, 30), fur, true) ?? [])]).toEqual([1, 1, 1, 0, 0]);
	});
});

const shade = new Color(0.1, 0.2, 0.3);

describe('a piece of the skin', () => {
	it('is darkened by its material where all is under fur', () => {
		const own = new MeshStandardMaterial({ color: new Color(0.5, 1, 1), roughness: 0.5 });
		const mesh = new Mesh(points(0, 1), own);
		const piece = new ShadedPiece(mesh, undefined);
		expect(mesh.material).toBe(piece.material);
		piece.shade(new Color(0, 0, 0));
		piece.shade(shade);
		expect(piece.material.color.toArray()).toEqual([0.05, 0.2, 0.3].map((c) => expect.closeTo(c)));
		expect(piece.material.roughness, 'dull').toBe(1);
		expect(piece.material).toBeInstanceOf(MatteMaterial);
		piece.shade(undefined);
		expect(piece.material.color.toArray()).toEqual(own.color.toArray());
		expect(piece.material.roughness).toBe(0.5);
		expect(own.color.r).toBeCloseTo(0.5);
	});

	it('leaves bare vertices their own colour', () => {
		const geometry = points(0, 1, 2).setAttribute(
			'color',
			attribute(4, [
				[1, 1, 1, 1],
				[0.5, 1, 1, 1],
				[0.5, 1, 1, 1],
			]),
		);
		const piece = new ShadedPiece(
			new Mesh(geometry, new MeshStandardMaterial({ vertexColors: true })),
			new Float32Array([1, 0, 0.5]),
		);
		piece.shade(new Color(0, 0, 0));
		piece.shade(shade);
		expect([...geometry.getAttribute('color').array]).toEqual(
			[0.1, 0.2, 0.3, 0.5, 1, 1, 0.275, 0.6, 0.65].map((c) => expect.closeTo(c)),
		);
		expect(piece.material.vertexColors).toBe(true);
	});
});

describe('the skin under wet fur', () => {
	const places = [
		[0, 0, 0],
		[1, 0, 0],
		[0, 1, 0],
	];
	const triangle = () =>
		new BufferGeometry()
			.setAttribute('position', attribute(3, places))
			.setAttribute(
				'normal',
				attribute(3, [
					[0, 0, 1],
					[0, 0, 1],
					[0, 0, 1],
				]),
			)
			.setIndex([0, 1, 2]);
	const fur = { ramp: { root: [1, 1, 1] } } as FurAsset;

	it('is darker where that is wet, and as before when it has dried', () => {
		const geometry = triangle();
		const body = new Mesh(geometry, new MeshStandardMaterial({ color: new Color(1, 0.5, 1) }));
		const skin = new Skin(body, [body], triangle());
		const material = () => body.material as MeshStandardMaterial;
		skin.cover(fur);
		const dry = material().color.toArray();
		const { version } = material();
		skin.soak(fur, undefined);
		expect(material().version).toBe(version);
		skin.soak(fur, { follicles: FurFollicles.of(triangle()), at: (follicle) => [0, 0.5, 1][follicle] ?? Number.NaN });
		expect(material().color.toArray()).toEqual([1, 0.5, 1]);
		expect(material().vertexColors).toBe(true);
		const red = Array.from({ length: 3 }, (_, v) => geometry.getAttribute('color').getX(v));
		expect(red).toEqual([0.35, 0.35 * 0.75, 0.35 * 0.5].map((c) => expect.closeTo(c)));
		skin.soak(fur, undefined);
		expect(material().vertexColors).toBe(false);
		expect(material().color.toArray()).toEqual(dry);
	});
});

describe('the skin of a body', () => {
	const fur = (root: RGB) => ({ ramp: { root } }) as FurAsset;
	const [fox, sheep] = [fur([0.1, 0, 0]), fur([0, 0.2, 0])];

	it('is as dark as below the fur that was put on last and is still there, and bright below none', () => {
		const body = new Mesh(points(0, 1), new MeshStandardMaterial({ color: new Color(1, 1, 1) }));
		const skin = new Skin(body, [body], undefined);
		const colour = () => (body.material as MeshStandardMaterial).color.toArray().map((c) => +c.toFixed(3));
		skin.cover(fox);
		expect(colour()).toEqual([0.035, 0, 0]);
		skin.cover(sheep);
		expect(colour()).toEqual([0, 0.07, 0]);
		skin.cover(fox);
		skin.bare(fox);
		expect(colour()).toEqual([0, 0.07, 0]);
		skin.bare(sheep);
		expect(colour()).toEqual([1, 1, 1]);
	});

	it('is measured by its largest side, where its node puts it', () => {
		const body = new Mesh(points(-1, 2), new MeshStandardMaterial());
		body.scale.setScalar(0.5);
		body.updateMatrix();
		expect(new Skin(body, [body], undefined).extent).toBeCloseTo(1.5);
	});
});

describe('a matte material', () => {
	it('takes the highlights of what is rough away, once, in a shader of its own', () => {
		const { vertexShader, fragmentShader } = ShaderLib.physical;
		const shader = { vertexShader, fragmentShader } as WebGLProgramParametersWithUniforms;
		new MatteMaterial().onBeforeCompile(shader);
		expect(shader.fragmentShader.split('directSpecular *= 1.0 - pow4(material.roughness)')).toHaveLength(2);
		expect(ShaderLib.physical).toMatchObject({ vertexShader, fragmentShader });
		expect(new MatteMaterial().customProgramCacheKey()).not.toBe(new MeshStandardMaterial().customProgramCacheKey());
		expect(new MatteMaterial().clone()).toBeInstanceOf(MatteMaterial);
	});

	it('leaves materials with more to them as they are', () => {
		expect(MatteMaterial.of(new MeshPhysicalMaterial({ clearcoat: 1 }))).toMatchObject({ clearcoat: 1 });
		const hooked = new MeshStandardMaterial();
		hooked.onBeforeCompile = () => {};
		expect(MatteMaterial.of(hooked)).not.toBeInstanceOf(MatteMaterial);
	});
});
