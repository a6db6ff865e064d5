/** Where the fur of a body is wet and where it is dirty, and how it dries. */

import { DataTexture, Matrix4, type Object3D, RGFormat, UnsignedByteType, Vector3 } from 'three';
import { FOLLICLES_PER_ROW, type Follicles } from './follicles.ts';

/** What 1 is stored as: a number that 2, 3, 4, 5, 6 and 8 divide, so that the usual states are met exactly. */
export const STAIN_STEPS = 240;

/** Seconds between two pictures of fur that dries. */
const PERIOD = 0.1;

/** How much mud rain takes away, share of how much it wets. */
const WASHED = 0.3;

/** Mud draws hairs together as water does: how wet dirt looks, share of it. */
const MATTED = 0.6;

/** Cosines between the skin at a brush's point and elsewhere, from which and to which more and more of it is reached. */
const ASIDE = -0.2;
const FACING = 0.3;

/** What weather has to know of a body: a `Fur`. */
export interface WeatheredBody {
	/** Points of the skin, in the axes of the shells. */
	readonly follicles: Follicles;
	/** Where they are. */
	readonly shells: Pick<Object3D, 'matrixWorld' | 'updateWorldMatrix'>;
	/** What it is worn by. */
	weather: FurWeather | undefined;
}

/** What a FurWeather may be told. */
export interface WeatherOptions {
	/** Seconds until soaked fur is dry; 40 by default. */
	drying?: number;
}

/** A share, 0..1; what is no number is 0. */
const bounded = (share: number) => Math.min(Math.max(share, 0), 1) || 0;

const inverse = new Matrix4();
const place = new Vector3();

/**
 * Wetness and dirt of a body's fur, painted in world coordinates.
 *
 *     const weather = new FurWeather(fur); // is fur.weather
 *     await fur.loadStates();
 *     weather.rain(point, 0.2, 0.5);
 *     // before each frame
 *     if (weather.update(seconds)) draw();
 *
 * What is painted shows with the next `update`. Painted fur dries, mud stays until it is washed off; `wetness` and `dirt`, of
 * the whole body, stay as they are set. Other furs of the same body take it by `dressed.weather = weather`.
 */
export class FurWeather {
	readonly #body: WeatheredBody;
	readonly #follicles: Follicles;
	readonly #rate: number;
	/** What is painted, of each follicle, 0..1. */
	readonly #wet: Float32Array;
	readonly #dirt: Float32Array;
	readonly #bytes: Uint8Array;
	readonly #texture: DataTexture;
	readonly #wearers = new Set<() => void>();
	#wetness = 0;
	#soiling = 0;
	#driest = 0;
	#wettest = 0;
	#dirtiest = 0;
	/** What is painted of the wettest follicle. */
	#left = 0;
	#changed = false;
	#elapsed = 0;

	/** @param body a fur, whose weather it becomes */
	constructor(body: WeatheredBody, { drying = 40 }: WeatherOptions = {}) {
		this.#body = body;
		this.#follicles = body.follicles;
		this.#rate = 1 / drying;
		const { count } = this.#follicles;
		this.#wet = new Float32Array(count);
		this.#dirt = new Float32Array(count);
		const rows = Math.ceil(count / FOLLICLES_PER_ROW);
		this.#bytes = new Uint8Array(2 * FOLLICLES_PER_ROW * rows);
		this.#texture = new DataTexture(this.#bytes, FOLLICLES_PER_ROW, rows, RGFormat, UnsignedByteType);
		this.#texture.name = 'stains';
		body.weather = this;
	}

	/** Of the whole body, 0..1: nothing is drier than that. */
	get wetness(): number {
		return this.#wetness;
	}

	set wetness(share: number) {
		const whole = bounded(share);
		this.#changed ||= whole !== this.#wetness;
		this.#wetness = whole;
	}

	/** Of the whole body, 0..1: nothing is cleaner than that. */
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
	 * @param radius world units; it falls off towards that
	 * @param amount at the point: 1 soaks dry fur
	 */
	rain(point: Vector3, radius: number, amount: number): void {
		this.#brush(point, radius, (i, share) => {
			this.#add(this.#wet, i, amount * share);
			this.#add(this.#dirt, i, -WASHED * amount * share);
		});
	}

	/** Soils. Parameters as of `rain`. */
	mud(point: Vector3, radius: number, amount: number): void {
		this.#brush(point, radius, (i, share) => this.#add(this.#dirt, i, amount * share));
	}

	/** Dry and clean: as baked. */
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
	 * @param seconds since the last time
	 * @returns whether something has changed that has to be drawn: while it dries ten times a second at most
	 */
	update(seconds: number): boolean {
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

	/** Whether a place is wetter or dirtier than the whole body is. */
	get painted(): boolean {
		const more = (whole: number) => (share: number) => share > whole + 0.5 / STAIN_STEPS;
		return this.#wet.some(more(this.#wetness)) || this.#dirt.some(more(this.#soiling));
	}

	/** Whether it still changes by itself. */
	get drying(): boolean {
		return this.#left > 0;
	}

	/**
	 * RG bytes, a texel for each follicle: wetness and dirt, 1 stored as 240. Undefined where all is dry and clean: shaders are
	 * then those of fur without weather.
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

	/** Has a fur of this body told when any of these has changed. */
	join(wearer: () => void): void {
		this.#wearers.add(wearer);
	}

	/** Tells it nothing any more. */
	leave(wearer: () => void): void {
		this.#wearers.delete(wearer);
	}

	/** Frees the texture. Furs are dry and clean then. */
	dispose(): void {
		this.clean();
		this.update(0);
		if (this.#body.weather === this) this.#body.weather = undefined;
		this.#wearers.clear();
		this.#texture.dispose();
	}

	/** All follicles within reach that look the way that the nearest one does: what is behind a thin ear stays dry. */
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
			// Nor where the brush has no size.
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

	/** @returns whether a byte is another */
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
		for (const wearer of this.#wearers) wearer();
		return true;
	}
}
