/** Furs of one body share motion and weather: attached alike, advanced once per frame, detached from all. */

import { readFileSync } from 'node:fs';
import { Color, Group, Mesh, Object3D, SphereGeometry, Texture } from 'three';
import { describe, expect, it, vi } from 'vitest';
import { furMethod } from '../../../web/fur/baselines/furMethod.ts';
import type { Skin } from '../../../web/fur/body/skin/Skin.ts';
import { dressFur } from '../../../web/fur/dressFur.ts';
import { Fur, type Ground } from '../../../web/fur/Fur.ts';
import { parseFur } from '../../../web/fur/format/extension.ts';
import type { FurAsset } from '../../../web/fur/format.ts';
import { FurInstances } from '../../../web/fur/herd/FurInstances.ts';
import { FurMotion } from '../../../web/fur/motion/FurMotion.ts';
import type { PeltStates } from '../../../web/fur/planes/PeltStates.ts';
import { updateFurs } from '../../../web/fur/updateFurs.ts';
import { FurWeather } from '../../../web/fur/weather/FurWeather.ts';

const golden = new URL('../../golden/ptm-6/model.gltf', import.meta.url);
const asset = parseFur(JSON.parse(readFileSync(golden, 'utf8')).extensions.FUR_ptm_shells) as FurAsset;

/** Two furs of one ball, without planes and fins. */
function pair(): [Fur, Fur] {
	const object = new Mesh();
	new Group().add(object);
	const ground: Ground = {
		skin: { object, cover() {}, bare() {}, soak() {} } as unknown as Skin,
		colour: new Color(1, 1, 1),
		surface: new SphereGeometry(1, 12, 8),
		placement: new Object3D(),
		quads: undefined,
		quadPlacement: undefined,
		finHeights: 1,
	};
	const states = { wet: [{}], dirty: undefined };
	const pelt = {
		...{
			cuts: [{ textures: { plane0: new Texture(), plane1: new Texture() } }],
			all: states,
			...states,
			loaded: false,
		},
		...{ subscribe() {}, unsubscribe() {}, request() {} },
	} as unknown as PeltStates;
	const grow = (surface: Ground['surface']) => new Fur(asset, pelt, { ...ground, surface }, 'vertices');
	const own = grow(ground.surface);
	return [own, grow(own.shells.geometry)];
}

const FRAME = 1 / 60;

describe.each([
	{ slot: 'motion' as const, make: (fur: Fur) => new FurMotion(fur) },
	{ slot: 'weather' as const, make: (fur: Fur) => new FurWeather(fur) },
])('$slot of a fur', ({ slot, make }) => {
	const attach = (fur: Fur, part: FurMotion | FurWeather) => Object.assign(fur, { [slot]: part });

	it('is attached by its constructor, to other furs by assignment, and detached from all by its end', () => {
		const [own, other] = pair();
		const part = make(own);
		expect([own[slot], other[slot]]).toEqual([part, undefined]);
		attach(other, part);
		expect(other[slot]).toBe(part);
		part.dispose();
		expect([own[slot], other[slot]]).toEqual([undefined, undefined]);
	});

	it('gives way to another, whose end does not bring it back', () => {
		const [own] = pair();
		const [first, second] = [make(own), make(own)];
		expect(own[slot]).toBe(second);
		first.dispose();
		expect(own[slot]).toBe(second);
	});

	it('is advanced once per frame, however many furs share it', () => {
		const [own, other] = pair();
		const part = make(own);
		attach(other, part);
		const update = vi.spyOn(part, 'update');
		updateFurs([own, other], FRAME);
		other.update(FRAME);
		expect(update.mock.calls).toEqual([[FRAME], [FRAME]]);
	});
});

it('bends hairs of all furs that share a motion, until its end', () => {
	const [own, other] = pair();
	const motion = new FurMotion(own);
	other.motion = motion;
	expect(updateFurs([own, other], FRAME)).toBe(false);
	motion.wind.strength = 1;
	for (let i = 0; i < 10; i++) expect(own.update(FRAME)).toBe(true);
	expect(own.swing).toBeInstanceOf(Texture);
	expect(other.swing).toBe(own.swing);
	motion.dispose();
	expect([own.swing, other.swing]).toEqual([undefined, undefined]);
});

it('shows changed weather with the next update, of no seconds too', () => {
	const [own] = pair();
	const weather = new FurWeather(own);
	weather.wetness = 0.5;
	expect([own.update(0), weather.wettest, own.update(0)]).toEqual([true, 0.5, false]);
});

it('has its length in the units of the model', () => {
	const [own] = pair();
	expect(own.length).toBeCloseTo(asset.length, 12);
	own.length = 1.5 * asset.length;
	expect([own.length / asset.length, own.shells.furLength / asset.length, own.material.trim]).toEqual([1.5, 1.5, 1]);
	expect(() => Object.assign(own, { length: Number.NaN })).toThrow('fur.length: got NaN, expected 0 or more');
	expect(own.length).toBeCloseTo(1.5 * asset.length, 12);
});

it.each([
	['dressFur', () => dressFur(pair()[0], undefined as unknown as Fur)],
	['dressFur', () => dressFur(undefined as unknown as Fur, pair()[0])],
	['FurMotion', () => new FurMotion(undefined as unknown as Fur)],
	['FurWeather', () => new FurWeather(undefined as unknown as Fur)],
	['FurInstances', () => new FurInstances(undefined as unknown as Fur, 3)],
	['furMethod', () => furMethod(undefined as unknown as Fur, 'unlit')],
])('%s says so where a model has no fur', (name, use) => {
	expect(use).toThrow(`${name}: got undefined, expected a fur, gltf.userData.fur of a model that has one`);
});
