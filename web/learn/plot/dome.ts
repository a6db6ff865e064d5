/** Half sphere of lamps over a slice of fur, seen from above and in front. */

import type { Direction } from '../../fur/reference.ts';
import type { Layer } from '../data/measurements.ts';
import type { RGB } from './colours.ts';
import { sliceImage } from './slice.ts';

/** Elevation of the view. */
const TILT = (34 * Math.PI) / 180;
/** Radius of the dome, and how far below the middle its centre is, in halves of the canvas. */
const RADIUS = 0.94;
const DROP = 0.14;
/** Half the slice's side, in radii. */
const HALF = 0.44;

const INK = '#e9e4dc';
const FAINT = 'rgb(233 228 220 / 22%)';
const WARM = '#ffd9a0';

type Point = readonly [x: number, y: number];

/** Projection of a point, in halves of the canvas: x to the right, y up. */
function project([u, v, z]: Direction): Point {
	return [RADIUS * u, RADIUS * (z * Math.cos(TILT) + v * Math.sin(TILT)) - DROP];
}

export class Dome {
	readonly #places: Point[];

	/** @param fitted number of lamps of the fit, the first ones */
	constructor(
		readonly lamps: readonly Direction[],
		readonly fitted: number,
	) {
		this.#places = lamps.map(project);
	}

	/** Lamp nearest to a point of the picture, -1..1, y up. */
	lampAt(x: number, y: number): number {
		let [best, found] = [Number.POSITIVE_INFINITY, 0];
		this.#places.forEach(([px, py], i) => {
			const away = (px - x) ** 2 + (py - y) ** 2;
			if (away < best) [best, found] = [away, i];
		});
		return found;
	}

	/** @param lit index of the lit lamp, @param colour of the layer's texels under it */
	draw(canvas: HTMLCanvasElement, lit: number, layer: Layer, colour: (place: number) => RGB): void {
		const context = canvas.getContext('2d');
		if (!context) return;
		const { width, height } = canvas;
		const half = width / 2;
		const at = (direction: Direction): [number, number] => {
			const [x, y] = project(direction);
			return [half * (1 + x), half * (1 - y)];
		};
		context.clearRect(0, 0, width, height);

		context.save();
		const [cx, cy] = at([0, 0, 0]);
		context.translate(cx, cy);
		context.scale(half * RADIUS * HALF, half * RADIUS * HALF * Math.sin(TILT));
		context.drawImage(sliceImage(layer, colour), -1, -1, 2, 2);
		context.restore();

		context.strokeStyle = FAINT;
		context.lineWidth = Math.max(half / 220, 1);
		for (const degrees of [0, 30, 60]) {
			const [out, up] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
			context.beginPath();
			for (let i = 0; i <= 72; i++) {
				const turn = (i / 36) * Math.PI;
				context.lineTo(...at([out * Math.cos(turn), out * Math.sin(turn), up]));
			}
			context.stroke();
		}

		context.beginPath();
		context.arc(cx, cy, half * RADIUS, Math.PI, 2 * Math.PI);
		context.stroke();
		const lamp = this.lamps[lit] ?? [0, 0, 1];
		const [x, y] = at(lamp);
		const ray = context.createLinearGradient(x, y, cx, cy);
		ray.addColorStop(0, WARM);
		ray.addColorStop(1, 'rgb(255 217 160 / 0%)');
		context.strokeStyle = ray;
		context.lineWidth = half / 60;
		context.beginPath();
		context.moveTo(x, y);
		context.lineTo(cx, cy);
		context.stroke();

		// Back to front.
		const order = [...this.lamps.keys()].sort((a, b) => (this.lamps[b]?.[1] ?? 0) - (this.lamps[a]?.[1] ?? 0));
		for (const i of order) {
			const direction = this.lamps[i] ?? [0, 0, 1];
			const size = (half / 46) * (1.05 - 0.3 * direction[1]);
			this.#lamp(context, at(direction), size, i);
		}
		const glow = context.createRadialGradient(x, y, 0, x, y, half / 7);
		glow.addColorStop(0, 'rgb(255 226 180 / 85%)');
		glow.addColorStop(1, 'rgb(255 226 180 / 0%)');
		context.fillStyle = glow;
		context.fillRect(x - half / 7, y - half / 7, (2 * half) / 7, (2 * half) / 7);
		context.fillStyle = '#fff';
		this.#lamp(context, [x, y], half / 30, lit, true);
	}

	#lamp(context: CanvasRenderingContext2D, [x, y]: Point, size: number, lamp: number, lit = false): void {
		context.beginPath();
		if (lamp < this.fitted) {
			context.arc(x, y, size, 0, 2 * Math.PI);
			context.fillStyle = lit ? '#fff' : 'rgb(233 228 220 / 72%)';
			context.fill();
			return;
		}
		const r = size * 1.25;
		context.moveTo(x, y - r);
		for (const [dx, dy] of [
			[r, 0],
			[0, r],
			[-r, 0],
		] as const)
			context.lineTo(x + dx, y + dy);
		context.closePath();
		context.fillStyle = lit ? '#fff' : '#171c21';
		context.fill();
		context.lineWidth = Math.max(size / 3, 1);
		context.strokeStyle = INK;
		context.stroke();
	}
}
