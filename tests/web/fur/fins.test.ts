import { BufferAttribute, BufferGeometry, Object3D, Scene, Texture, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import type { Fin, FurAsset } from '../../../web/fur/format.ts';
import { FurFinMaterial } from '../../../web/fur/shells/FurFinMaterial.ts';
import { FurFins } from '../../../web/fur/shells/FurFins.ts';
import { FurMaterial } from '../../../web/fur/shells/FurMaterial.ts';
import { FurShells } from '../../../web/fur/shells/FurShells.ts';
import { followHue } from '../../../web/fur/shells/hue.ts';
import type { PeltMaterial } from '../../../web/fur/shells/PeltMaterial.ts';

const six = [1, 1, 1, 1, 1, 1];
const light = {
	scale: six,
	bias: six,
	basis: { kind: 'ptm' } as const,
	environment: six.map(() => new Array(9).fill(0)),
};
const fin: Fin = { ...light, width: 64, height: 16, planes: [2, 3] };
const asset: FurAsset = {
	...light,
	version: '1.0',
	skin: 0,
	shells: 1,
	fins: 2,
	tiles: 4,
	layers: 2,
	size: 8,
	coefficients: 6,
	length: 0.3,
	height: 0.5,
	drift: [
		[0, 0],
		[0, 0],
	],
	ramp: { root: [0, 0, 0], tip: [1, 1, 1], tip2: [1, 1, 1], power: 1 },
	pelts: [{ ...light, name: 'dry', planes: [0, 1], fin }],
};

function geometry(...points: number[]): BufferGeometry {
	return new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
}

function node(x: number, scale: number): Object3D {
	const placement = new Object3D();
	placement.position.set(x, 0, 0);
	placement.scale.setScalar(scale);
	return placement;
}

function grow(placement: Object3D, quads = geometry(0, 0, 0, 1, 0, 0)) {
	const textures = { plane0: new Texture(), plane1: new Texture() };
	const material = new FurMaterial(asset, textures);
	const fins = new FurFins(quads, new FurFinMaterial(fin, textures, material));
	const shells = new FurShells(geometry(0, 0, 0, 1, 0, 0), node(-2, 3), asset, material);
	fins.join(shells, placement);
	return { fins, shells };
}

describe('FurFins', () => {
	it('are sorted before their shells from everywhere: equally far to the bit, and older', () => {
		for (const placement of [node(-2, 3), node(0.1, 0.7)]) {
			const { fins, shells } = grow(placement);
			for (const part of [fins, shells]) part.updateMatrixWorld();
			expect(fins.matrixWorld.elements).toEqual(shells.matrixWorld.elements);
			expect(fins.geometry.boundingSphere?.center).toEqual(shells.geometry.boundingSphere?.center);
			expect(fins.id).toBeLessThan(shells.id);
			expect(fins.renderOrder).toBe(shells.renderOrder);
		}
	});

	it('stay where their own node puts them', () => {
		const placement = node(0.1, 0.7);
		const { fins } = grow(placement, geometry(0.5, 1, -1));
		placement.updateMatrixWorld();
		fins.updateMatrixWorld();
		const point = new Vector3().fromBufferAttribute(fins.geometry.getAttribute('position'), 0);
		const expected = new Vector3(0.5, 1, -1).applyMatrix4(placement.matrixWorld);
		expect(point.applyMatrix4(fins.matrixWorld).distanceTo(expected)).toBeLessThan(1e-6);
	});

	it('have room in their sphere for hairs that stand out', () => {
		const { fins, shells } = grow(node(-2, 3));
		fins.material.finLength = 1.25;
		fins.fit(shells);
		const [outer = 0, inner = 0] = [fins, shells].map((part) => part.geometry.boundingSphere?.radius);
		expect(outer - inner).toBeCloseTo(0.025, 6);
	});
});

describe('FurFinMaterial', () => {
	it('has colours, length and units of the shells, now and later', () => {
		const { fins, shells } = grow(node(-2, 3));
		shells.material.furLength = 0.7;
		shells.material.tip.setRGB(0.1, 0.2, 0.3);
		shells.material.rampPower = 2;
		for (const name of ['furLength', 'tip', 'tip2', 'rampPower', 'skinColor', 'tiles'])
			expect(fins.material.uniforms[name]?.value, name).toBe(shells.material.uniforms[name]?.value);
		expect(fins.material.uniforms.tiles?.value).toBe(4);
	});

	it('blends without writing depth, from both sides', () => {
		const { fins, shells } = grow(node(-2, 3));
		expect([fins.material.depthWrite, fins.material.depthTest, fins.material.transparent]).toEqual([false, true, true]);
		expect([fins.material.blendSrc, fins.material.blendDst]).toEqual([
			shells.material.blendSrc,
			shells.material.blendDst,
		]);
	});
});

describe('varyings', () => {
	/** Lines that a compiler sees, as far as `#ifdef` decides it. */
	function compiled({ vertexShader, defines }: PeltMaterial): string {
		const kept: boolean[] = [];
		return vertexShader
			.split('\n')
			.filter((line) => {
				const [, directive, name = ''] = line.match(/^#(if\w*|else|endif)\b *(\w*)/) ?? [];
				if (directive === 'ifdef') kept.push(name in defines);
				else if (directive === 'ifndef') kept.push(!(name in defines));
				else if (directive?.startsWith('if')) kept.push(true);
				else if (directive === 'else') kept.push(!kept.pop());
				else if (directive) kept.pop();
				return kept.every(Boolean);
			})
			.join('\n');
	}

	/** A herd's fragments read either of them, by `ALPHA_TO_COVERAGE`, which three gives fragments alone. */
	const EITHER = ['vShells', 'vFacing'];

	/** Rows of the packing that GLSL ES fixes: a vec4, a vec3 and each column of a matrix take a row, the rest fits beside. */
	function rows(material: PeltMaterial): number {
		const all = [...compiled(material).matchAll(/^(?:flat |centroid )?out (\w+) (\w+);/gm)];
		const ofDefines: Record<string, string> = {
			Strength: 'ONE_HUE' in material.defines ? 'float' : 'vec3',
			Ramp: material.defines.REGIONS === 2 ? 'vec3' : 'float', // see regions/furs.glsl
			uint: 'float',
		};
		const either = EITHER.every((wanted) => all.some(([, , name]) => name === wanted));
		const found = all
			.filter(([, , name]) => !(either && name === EITHER[0]))
			.map(([, type = '']) => ofDefines[type] ?? type);
		const count = (type: string) => found.filter((name) => name === type).length;
		const three = 3 * count('mat3') + count('vec3');
		const four = count('vec4');
		const pairs = Math.ceil(count('vec2') / 2);
		const scalars = Math.max(count('float') - three - (count('vec2') % 2) * 2, 0);
		expect(four + count('mat3') + count('vec3') + count('vec2') + count('float')).toBe(found.length);
		return four + three + pairs + Math.ceil(scalars / 4);
	}

	it('are no more than WebGL2 promises, and fewer without what is switched off', () => {
		const { fins, shells } = grow(node(-2, 3));
		shells.material.environment = false;
		expect([fins, shells].map(({ material }) => rows(material))).toEqual([8, 8]);
		Object.assign(shells.material, { environment: true, gloss: 0.5, backlight: 6 });
		expect([fins, shells].map(({ material }) => rows(material))).toEqual([12, 12]);
		// With a picture of the roots, and furs of regions, in mud and rain.
		Object.assign(shells.material.defines, {
			ROOTS: '',
			COLOUR_PLANE: '',
			WET: 3,
			DIRTY: '',
			SHADOW_PER_FRAGMENT: '',
			SHADOW_SHARE: '',
		});
		expect(rows(shells.material)).toBeLessThanOrEqual(15);
		shells.material.defines.BODIES = '';
		expect(rows(shells.material), 'in a herd').toBeLessThanOrEqual(15);
		delete shells.material.defines.BODIES;
		Object.assign(shells.material.defines, { REGIONS: 2, PARTED: '' });
		expect(rows(shells.material)).toBeLessThanOrEqual(15);
		shells.material.defines.BODIES = '';
		expect(rows(shells.material), 'in a herd').toBeLessThanOrEqual(15);
		delete shells.material.defines.BODIES;
		for (const name of [
			'ROOTS',
			'COLOUR_PLANE',
			'WET',
			'DIRTY',
			'REGIONS',
			'PARTED',
			'SHADOW_PER_FRAGMENT',
			'SHADOW_SHARE',
		])
			delete shells.material.defines[name];
		shells.material.lampsPerFragment = true;
		for (const { material } of [fins, shells]) {
			expect(rows(material)).toBeLessThanOrEqual(15);
			// As of mean curves.
			material.defines.MEAN_CURVES = '';
			expect(rows(material)).toBeLessThanOrEqual(15);
		}
		Object.assign(shells.material, { lampsPerFragment: false, environment: false, gloss: 0 });
		for (const { material } of [fins, shells]) {
			followHue(material, new Scene());
			expect(rows(material)).toBeLessThanOrEqual(5);
		}
	});
});
