import { BufferAttribute, BufferGeometry, Group, Matrix4, Object3D, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { FurFollicles } from '../../../../web/fur/body/FurFollicles.ts';
import { FurWeather, type FurWeatherBody } from '../../../../web/fur/weather/FurWeather.ts';

/** Two sheets of 11 × 11 points over the unit square, 0.02 apart, the front one facing +z, the back one −z: a thin ear. */
function ear(): BufferGeometry {
	const [positions, normals, corners]: number[][] = [[], [], []] as never;
	for (const side of [1, -1]) {
		const first = (positions?.length ?? 0) / 3;
		for (let i = 0; i < 121; i++) {
			positions?.push((i % 11) / 10, Math.floor(i / 11) / 10, 0.01 * side);
			normals?.push(0, 0, side);
		}
		for (let i = 0; i < 100; i++) {
			const at = first + Math.floor(i / 10) * 11 + (i % 10);
			corners?.push(at, at + 1, at + 11, at + 1, at + 12, at + 11);
		}
	}
	return new BufferGeometry()
		.setAttribute('position', new BufferAttribute(Float32Array.from(positions ?? []), 3))
		.setAttribute('normal', new BufferAttribute(Float32Array.from(normals ?? []), 3))
		.setIndex(corners ?? []);
}

function painted(drying?: number, matrixWorld = new Matrix4()) {
	const follicles = FurFollicles.of(ear());
	const shells = new Object3D();
	shells.applyMatrix4(matrixWorld);
	const body: FurWeatherBody = { follicles, shells, weather: undefined };
	const weather = new FurWeather(body, drying ? { drying } : {});
	const at = (x: number, y: number, front = true) => {
		const { position, normal, count } = follicles;
		for (let i = 0; i < count; i++) {
			const near = Math.hypot((position[3 * i] ?? 9) - x, (position[3 * i + 1] ?? 9) - y) < 1e-3;
			if (near && (normal[3 * i + 2] ?? 0) > 0 === front) return i;
		}
		throw new Error('no follicle there');
	};
	const texel = (i: number) => {
		const data = weather.stains?.image.data as Uint8Array | undefined;
		return [data?.[2 * i], data?.[2 * i + 1]];
	};
	return { body, shells, weather, at, texel, follicles };
}

describe('the brush', () => {
	it('is a smooth spot on the side that it is held to', () => {
		const { body, weather, at, texel } = painted();
		expect(body.weather).toBe(weather);
		expect([weather.stains, weather.drying]).toEqual([undefined, false]);
		weather.rain(new Vector3(0.5, 0.5, 0.03), 0.35, 1);
		expect(weather.update(0)).toBe(true);
		const [middle, beside, edge] = [at(0.5, 0.5), at(0.6, 0.5), at(0.8, 0.5)].map((i) => texel(i)[0] as number);
		expect(middle).toBeGreaterThan(230);
		expect(beside).toBeLessThan(middle as number);
		expect(beside).toBeGreaterThan(edge as number);
		expect(edge).toBeGreaterThan(0);
		expect(texel(at(0.9, 0.5))).toEqual([0, 0]);
		expect(texel(at(0.5, 0.5, false)), 'behind').toEqual([0, 0]);
		expect([weather.driest, weather.wettest]).toEqual([0, (middle as number) / 240]);
		expect(weather.update(0), 'nothing new').toBe(false);
	});

	it('has its place and its size in the world', () => {
		const matrixWorld = new Matrix4()
			.makeRotationY(Math.PI / 2)
			.scale(new Vector3(3, 3, 3))
			.setPosition(5, 6, 7);
		const { weather, at, texel } = painted(undefined, matrixWorld);
		weather.rain(new Vector3(0.2, 0.4, 0.02).applyMatrix4(matrixWorld), 0.6, 0.5);
		weather.update(0);
		expect(texel(at(0.2, 0.4))[0]).toBeGreaterThan(110);
		expect(texel(at(0.3, 0.4))[0]).toBeGreaterThan(20);
		expect(texel(at(0.4, 0.4))).toEqual([0, 0]);
	});

	it('finds a body that has been moved since it was drawn', () => {
		const { shells, weather, at, texel } = painted();
		new Group().add(shells).position.set(7, 0, 0);
		weather.rain(new Vector3(7.2, 0.4, 0.02), 0.2, 0.5);
		weather.update(0);
		expect(texel(at(0.2, 0.4))[0]).toBeGreaterThan(110);
		expect(texel(at(0.5, 0.4))).toEqual([0, 0]);
	});

	it('soils, mats what is muddy, and rain washes a little of it away', () => {
		const { weather, at, texel } = painted();
		const point = new Vector3(0.5, 0.5, 0.02);
		weather.mud(point, 0.3, 0.8);
		weather.update(0);
		const [matted = 0, muddy = 0] = texel(at(0.5, 0.5));
		expect(muddy).toBeGreaterThan(185);
		expect(matted / muddy).toBeCloseTo(0.6, 1);
		expect(weather.drying, 'mud stays').toBe(false);
		weather.rain(point, 0.3, 0.5);
		weather.update(0);
		expect(texel(at(0.5, 0.5))[1]).toBeLessThan(muddy - 20);
		expect(texel(at(0.5, 0.5))[1]).toBeGreaterThan(muddy - 60);
	});
});

describe('wet fur', () => {
	it('dries within its time, drawn ten times a second', () => {
		const { weather, at, texel } = painted(2);
		weather.rain(new Vector3(0.5, 0.5, 0.02), 0.3, 1);
		weather.update(0);
		let drawn = 0;
		for (let frame = 0; frame < 60; frame++) if (weather.update(1 / 60)) drawn++;
		expect(drawn).toBeGreaterThan(7);
		expect(drawn).toBeLessThan(11);
		expect(Math.abs((texel(at(0.5, 0.5))[0] as number) - 120)).toBeLessThan(10);
		expect(weather.drying).toBe(true);
		for (let frame = 0; frame < 70; frame++) weather.update(1 / 60);
		expect([weather.drying, weather.stains, weather.wettest]).toEqual([false, undefined, 0]);
		expect(weather.update(1)).toBe(false);
	});

	it('is no drier than the whole body is told to be, exactly', () => {
		const { weather, texel, follicles } = painted(1);
		weather.wetness = 0.25;
		weather.dirt = 0.1;
		expect(weather.stains, 'before the update').toBeUndefined();
		expect(weather.update(0)).toBe(true);
		expect(texel(follicles.count - 1)).toEqual([60, 24]);
		for (let second = 0; second < 9; second++) expect(weather.update(1)).toBe(false);
		expect([weather.driest, weather.wettest, weather.dirtiest]).toEqual([0.25, 0.25, 0.1]);
	});

	it('is soaked at most, and dry where it is told what is no number', () => {
		const { weather, texel } = painted();
		Object.assign(weather, { wetness: 2, dirt: -1 });
		weather.update(0);
		expect([weather.wetness, weather.wettest, weather.dirt, ...texel(0)]).toEqual([1, 1, 0, 240, 0]);
		weather.wetness = Number.NaN;
		weather.update(0);
		weather.rain(new Vector3(0.5, 0.5, 0.02), 0.3, Number.NaN);
		weather.update(0);
		expect([weather.stains, weather.update(0)]).toEqual([undefined, false]);
	});

	it('is painted where it is wetter or dirtier than the whole body, not where mud mats it', () => {
		const { weather } = painted(1);
		Object.assign(weather, { wetness: 0.3, dirt: 1 });
		weather.update(0);
		expect([weather.painted, weather.wettest]).toEqual([false, 0.6]);
		weather.rain(new Vector3(0.5, 0.5, 0.02), 0.2, 0.8);
		expect(weather.painted).toBe(true);
		for (let second = 0; second < 2; second++) weather.update(1);
		expect(weather.painted, 'dry').toBe(false);
		weather.dirt = 0.5;
		weather.mud(new Vector3(0.5, 0.5, 0.02), 0.2, 0.8);
		expect(weather.painted).toBe(true);
		weather.clean();
		expect(weather.painted, 'at once').toBe(false);
	});

	it('can be as baked again at once, and tells those who wear it', () => {
		const { body, weather } = painted();
		let told = 0;
		weather.join({ follow: () => told++, detach: () => (body.weather = undefined) });
		weather.wetness = 1;
		weather.mud(new Vector3(), 1, 1);
		weather.update(0);
		weather.clean();
		expect(weather.update(0)).toBe(true);
		expect([told, weather.stains, weather.wetness, weather.dirt]).toEqual([2, undefined, 0, 0]);
		weather.dispose();
		expect(body.weather).toBeUndefined();
	});
});
