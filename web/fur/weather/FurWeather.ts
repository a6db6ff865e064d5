/** Wetness and dirt over a body's fur, and its drying. */

import { DataTexture, Matrix4, type Object3D, RGFormat, UnsignedByteType, Vector3 } from 'three';
import { FurAttachment } from '../body/FurAttachment.ts';
import type { FurFollicles } from '../body/FurFollicles.ts';
import { needFur } from '../needFur.ts';

/** Byte that stores 1; divisible by 2, 3, 4, 5, 6 and 8, so that the usual states are exact. */
export const STAIN_STEPS = 240;

/** Seconds between two pictures of drying fur. */
const PERIOD = 0.1;

/** Mud washed off by rain, share of the added wetness. */
const WASHED = 0.3;

/** Wetness of dirty fur, share of its dirt: mud mats hairs as water does. */
const MATTED = 0.6;

/** Cosines between the normals at the brush and elsewhere, from which the brush begins to reach and to which it reaches fully. */
const ASIDE = -0.2;
const FACING = 0.3;

/** Body under the weather: a `Fur`. */
export interface FurWeatherBody {
	/** Points of the skin, in the axes of the shells. */
	readonly follicles: FurFollicles;
	/** Placement of the follicles' axes. */
	readonly shells: Pick<Object3D, 'matrixWorld' | 'updateWorldMatrix'>;
	/** Attached weather, if any. */
	weather: FurWeather | undefined;
}

/** Options of FurWeather. */
export interface FurWeatherOptions {
	/** Seconds until soaked fur is dry; 40 by default. */
	drying?: number;
}

/** Share clamped to 0..1; NaN is 0. */
const bounded = (share: number) => Math.min(Math.max(share, 0), 1) || 0;

const inverse = new Matrix4();
const place = new Vector3();

/**
 * Wetness and dirt of a body's fur, painted in world coordinates.
 *
 *     const weather = new FurWeather(fur, { drying: 20 }); // is fur.weather
 *     await fur.loadStates();
 *     weather.rain(point, 0.2, 0.5);
 *     // each frame, before it is drawn
 *     fur.update(seconds);
 *
 * Paint shows with the next `Fur.update`. Painted fur dries, mud stays until it is washed off; `wetness` and `dirt`, of the
 * whole body, stay as set. Other furs of the same body share it by `dressed.weather = weather`.
 */
export class FurWeather extends FurAttachment {
	readonly #body: FurWeatherBody;
	readonly #follicles: FurFollicles;
	readonly #rate: number;
	/** Painted wetness of each follicle, 0..1. */
	readonly #wet: Float32Array;
	readonly #dirt: Float32Array;
	readonly #bytes: Uint8Array;
	readonly #texture: DataTexture;
	#wetness = 0;
	#soiling = 0;
	#driest = 0;
	#wettest = 0;
	#dirtiest = 0;
	/** Largest painted wetness. */
	#left = 0;
	#changed = false;
	#elapsed = 0;

	/** @param body fur to attach to, in place of its weather before */
	constructor(body: FurWeatherBody, { drying = 40 }: FurWeatherOptions = {}) {
		super();
		needFur('FurWeather', body);
		this.#body = body;
		this.#follicles = body.follicles;
		this.#rate = 1 / drying;
		const { count, columns, rows } = this.#follicles;
		this.#wet = new Float32Array(count);
		this.#dirt = new Float32Array(count);
		this.#bytes = new Uint8Array(2 * columns * rows);
		this.#texture = new DataTexture(this.#bytes, columns, rows, RGFormat, UnsignedByteType);
		this.#texture.name = 'stains';
		body.weather = this;
	}

	/** Wetness of the whole body, 0..1: a lower bound everywhere. */
	get wetness(): number {
		return this.#wetness;
	}

	set wetness(share: number) {
		const whole = bounded(share);
		this.#changed ||= whole !== this.#wetness;
		this.#wetness = whole;
	}

	/** Dirt of the whole body, 0..1: a lower bound everywhere. */
	get dirt(): number {
		return this.#soiling;
	}

	set dirt(share: number) {
		const whole = bounded(share);
		this.#changed ||= whole !== this.#soiling;
		this.#soiling = whole;
	}

	/**
	 * Wets, and washes a little.
	 *
	 * @param point on the skin or in the fur, world units
	 * @param radius falls off to 0 there; world units
	 * @param amount at the point: 1 soaks dry fur
	 */
	rain(point: Vector3, radius: number, amount: number): void {
		this.#brush(point, radius, (i, share) => {
			this.#add(this.#wet, i, amount * share);
			this.#add(this.#dirt, i, -WASHED * amount * share);
		});
	}

	/** Soils. Parameters as in `rain`. */
	mud(point: Vector3, radius: number, amount: number): void {
		this.#brush(point, radius, (i, share) => this.#add(this.#dirt, i, amount * share));
	}

	/** Resets to dry and clean. */
	clean(): void {
		this.#wet.fill(0);
		this.#dirt.fill(0);
		this.#wetness = this.#soiling = 0;
		this.#left = 0;
		this.#changed = true;
	}

	/**
	 * Dries.
	 *
	 * @param seconds since the last call
	 * @returns whether the picture changes; at most ten times a second by drying
	 * @internal
	 */
	override update(seconds: number): boolean {
		if (this.#left > 0) {
			this.#elapsed += seconds;
			if (this.#elapsed >= PERIOD) {
				const loss = this.#elapsed * this.#rate;
				for (let i = 0; i < this.#wet.length; i++) this.#wet[i] = Math.max((this.#wet[i] as number) - loss, 0);
				this.#left = Math.max(this.#left - loss, 0);
				this.#elapsed = 0;
				this.#changed = true;
			}
		}
		if (!this.#changed) return false;
		this.#changed = false;
		return this.#write();
	}

	/** Whether any place is wetter or dirtier than the whole body. */
	get painted(): boolean {
		const more = (whole: number) => (share: number) => share > whole + 0.5 / STAIN_STEPS;
		return this.#wet.some(more(this.#wetness)) || this.#dirt.some(more(this.#soiling));
	}

	/** Whether painted fur is still drying. */
	get drying(): boolean {
		return this.#left > 0;
	}

	/**
	 * RG bytes, a texel per follicle: wetness and dirt, 1 stored as 240. Undefined where all is dry and clean: shaders are then
	 * those without weather.
	 */
	get stains(): DataTexture | undefined {
		return this.#wettest > 0 || this.#dirtiest > 0 ? this.#texture : undefined;
	}

	/** Wetness of the driest place, 0..1, as last shown. */
	get driest(): number {
		return this.#driest;
	}

	/** Wetness of the wettest place. */
	get wettest(): number {
		return this.#wettest;
	}

	/** Dirt of the dirtiest place. */
	get dirtiest(): number {
		return this.#dirtiest;
	}

	/** Wetness of a follicle, 0..1, as last shown. */
	wetnessAt(follicle: number): number {
		return (this.#bytes[2 * follicle] as number) / STAIN_STEPS;
	}

	/** Frees the texture and leaves furs dry and clean. */
	override dispose(): void {
		super.dispose();
		this.#texture.dispose();
	}

	/** Paint all follicles within reach that face as the nearest one does: the back of a thin ear stays dry. */
	#brush(point: Vector3, radius: number, paint: (i: number, share: number) => void): void {
		const { shells } = this.#body;
		shells.updateWorldMatrix(true, false);
		const { matrixWorld } = shells;
		const { position, normal, count } = this.#follicles;
		const { x, y, z } = place.copy(point).applyMatrix4(inverse.copy(matrixWorld).invert());
		const reach = (radius / matrixWorld.getMaxScaleOnAxis()) ** 2;
		const away = (i: number) =>
			((position[3 * i] as number) - x) ** 2 +
			((position[3 * i + 1] as number) - y) ** 2 +
			((position[3 * i + 2] as number) - z) ** 2;
		let nearest = 0;
		let closest = Number.POSITIVE_INFINITY;
		for (let i = 0; i < count; i++) {
			const distance = away(i);
			if (distance >= closest) continue;
			closest = distance;
			nearest = i;
		}
		const [nx, ny, nz] = [normal[3 * nearest], normal[3 * nearest + 1], normal[3 * nearest + 2]] as [
			number,
			number,
			number,
		];
		for (let i = 0; i < count; i++) {
			const distance = away(i) / reach;
			// Also false for a brush of size 0.
			if (!(distance < 1)) continue;
			const alike =
				(normal[3 * i] as number) * nx + (normal[3 * i + 1] as number) * ny + (normal[3 * i + 2] as number) * nz;
			const facing = bounded((alike - ASIDE) / (FACING - ASIDE));
			if (facing > 0) paint(i, facing * (1 - distance) ** 2);
		}
		this.#changed = true;
	}

	#add(painted: Float32Array, i: number, amount: number): void {
		const value = bounded((painted[i] as number) + amount);
		painted[i] = value;
		if (painted === this.#wet) this.#left = Math.max(this.#left, value);
	}

	/** @returns whether any byte has changed */
	#write(): boolean {
		let [driest, wettest, dirtiest, changed] = [STAIN_STEPS, 0, 0, false];
		for (let i = 0; i < this.#wet.length; i++) {
			const soiled = Math.max(this.#dirt[i] as number, this.#soiling);
			const dirt = Math.round(STAIN_STEPS * soiled);
			const wet = Math.round(STAIN_STEPS * Math.max(this.#wet[i] as number, this.#wetness, MATTED * soiled));
			if (wet < driest) driest = wet;
			if (wet > wettest) wettest = wet;
			if (dirt > dirtiest) dirtiest = dirt;
			changed ||= this.#bytes[2 * i] !== wet || this.#bytes[2 * i + 1] !== dirt;
			this.#bytes[2 * i] = wet;
			this.#bytes[2 * i + 1] = dirt;
		}
		if (!changed) return false;
		this.#driest = driest / STAIN_STEPS;
		this.#wettest = wettest / STAIN_STEPS;
		this.#dirtiest = dirtiest / STAIN_STEPS;
		this.#texture.needsUpdate = true;
		this.show();
		return true;
	}
}
