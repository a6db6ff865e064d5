/** The limb on its canvas: hairs in the lamp's light, the lamp, and the watched vertex with its frame before and after. */

import { frameAt, lightOf, momentsIn, type Vector } from './frame.ts';
import { type Hairs, Hairs as Limb, watchedAt } from './hairs.ts';

/** Middle of the picture in the limb's units, and how many of them are across and up. */
const MIDDLE = [0.04, 0.14] as const;
const [ACROSS, UP] = [3.6, 3.4];
/** Way of the lamp around the joint, and of a frame's arrows. */
const [LAMP, ARROW] = [1.62, 0.46];
/** Colours of the fur from its darkest to its brightest: few at first, then all between. */
const RAMP = [
	[34, 24, 17],
	[75, 52, 35],
	[122, 87, 59],
	[169, 128, 88],
	[211, 174, 128],
	[242, 218, 181],
];
const SHADES = Array.from({ length: 64 }, (_, i) => {
	const at = (i / 63) * (RAMP.length - 1);
	const [from, to] = [RAMP[Math.floor(at)], RAMP[Math.ceil(at)]] as [number[], number[]];
	return `rgb(${from.map((value, c) => Math.round(value + (at % 1) * ((to[c] as number) - value))).join(' ')})`;
});
const SKIN = '#251b14';
/** Light from all around, which no frame turns. */
const SKY = 0.16;
const AXES = { T: '#ff7a5c', N: '#7fc4ff', B: '#b8e06a' } as const;
const RIM = 'rgb(20 26 32 / 80%)';
const LIGHT = '#ffd9a0';
const PALE = 'rgb(255 255 255 / 55%)';

/** Scale between the limb's units and pixels of a canvas. */
export class Sheet {
	readonly #unit: number;

	constructor(
		readonly width: number,
		readonly height: number,
	) {
		this.#unit = Math.min(width / ACROSS, height / UP);
	}

	/** Pixels per unit. */
	get unit(): number {
		return this.#unit;
	}

	x(x: number): number {
		return this.width / 2 + (x - MIDDLE[0]) * this.#unit;
	}

	y(y: number): number {
		return this.height / 2 - (y - MIDDLE[1]) * this.#unit;
	}

	/** Angle of the joint that brings the forearm under a pixel, radians. */
	angleTo(px: number, py: number): number {
		const [x, y] = [(px - this.width / 2) / this.#unit + MIDDLE[0], (this.height / 2 - py) / this.#unit + MIDDLE[1]];
		return Math.atan2(y, x);
	}
}

/** @param angle of the joint, radians; @param coefficients of the fur; @param brightest L, for the scale of colours */
export function drawLimb(
	canvas: HTMLCanvasElement,
	hairs: Hairs,
	angle: number,
	light: Vector,
	coefficients: readonly number[],
	brightest: number,
): void {
	const context = canvas.getContext('2d');
	if (!context) return;
	const sheet = new Sheet(canvas.width, canvas.height);
	context.clearRect(0, 0, canvas.width, canvas.height);
	context.lineCap = 'round';
	context.fillStyle = SKIN;
	outline(context, sheet, angle);
	context.fill();
	context.lineWidth = 0.017 * sheet.unit;
	hairs.pose(angle, ({ root, tip, frame, shade }) => {
		const lit = SKY + (1 - SKY) * Math.min(lightOf(coefficients, momentsIn(frame, light)) / brightest, 1.1);
		const [x, y] = [sheet.x(root[0]), sheet.y(root[1])];
		const up = [frame.normal[0], frame.normal[1]].map((n) => 0.12 * n) as [number, number];
		const [bendX, bendY] = [sheet.x(root[0] + up[0]), sheet.y(root[1] + up[1])];
		const [tipX, tipY] = [sheet.x(tip[0]), sheet.y(tip[1])];
		// The lower half is in the shade of its neighbours.
		const [midX, midY] = [(x + 2 * bendX + tipX) / 4, (y + 2 * bendY + tipY) / 4];
		stroke(context, colourOf(0.55 * lit * shade), x, y, (x + bendX) / 2, (y + bendY) / 2, midX, midY);
		stroke(context, colourOf(lit * shade), midX, midY, (bendX + tipX) / 2, (bendY + tipY) / 2, tipX, tipY);
	});
	if (angle !== 0) drawBefore(context, sheet);
	drawLamp(context, sheet, light, watchedAt(angle));
	drawFrame(context, sheet, angle, true);
}

function stroke(
	context: CanvasRenderingContext2D,
	colour: string,
	...way: [number, number, number, number, number, number]
) {
	const [x, y, ...rest] = way;
	context.strokeStyle = colour;
	context.beginPath();
	context.moveTo(x, y);
	context.quadraticCurveTo(...(rest as [number, number, number, number]));
	context.stroke();
}

function colourOf(light: number): string {
	const at = Math.min(Math.max(light, 0), 1) * (SHADES.length - 1);
	return SHADES[Math.round(at)] as string;
}

function outline(context: CanvasRenderingContext2D, sheet: Sheet, angle: number): void {
	context.beginPath();
	for (const [x, y] of Limb.outline(angle)) context.lineTo(sheet.x(x), sheet.y(y));
	context.closePath();
}

/** The limb before its joint turned: outline and frame, pale. */
function drawBefore(context: CanvasRenderingContext2D, sheet: Sheet): void {
	context.save();
	context.strokeStyle = PALE;
	context.lineWidth = 0.01 * sheet.unit;
	context.setLineDash([0.03 * sheet.unit, 0.035 * sheet.unit]);
	outline(context, sheet, 0);
	context.stroke();
	context.restore();
	drawFrame(context, sheet, 0, false);
}

/** T and N as arrows, B as the end of one that points away from the reader. @param now false: before the turn */
function drawFrame(context: CanvasRenderingContext2D, sheet: Sheet, angle: number, now: boolean): void {
	const [px, py] = watchedAt(angle);
	const { tangent, normal } = frameAt(angle);
	const [x, y] = [sheet.x(px), sheet.y(py)];
	context.save();
	context.globalAlpha = now ? 1 : 0.45;
	context.font = `600 ${Math.max(0.105 * sheet.unit, 11)}px system-ui, sans-serif`;
	context.textAlign = 'center';
	context.textBaseline = 'middle';
	for (const [name, [dx, dy]] of [
		['T', tangent],
		['N', normal],
	] as const) {
		const [toX, toY] = [sheet.x(px + ARROW * dx), sheet.y(py + ARROW * dy)];
		arrow(context, x, y, toX, toY, AXES[name], 0.022 * sheet.unit);
		label(context, name, sheet.x(px + 1.24 * ARROW * dx), sheet.y(py + 1.24 * ARROW * dy), AXES[name]);
	}
	const size = 0.05 * sheet.unit;
	context.fillStyle = '#1d242b';
	context.strokeStyle = AXES.B;
	context.lineWidth = 0.017 * sheet.unit;
	context.beginPath();
	context.arc(x, y, size, 0, 2 * Math.PI);
	context.fill();
	context.stroke();
	const half = size * Math.SQRT1_2;
	context.beginPath();
	for (const sign of [-1, 1]) {
		context.moveTo(x - half, y - sign * half);
		context.lineTo(x + half, y + sign * half);
	}
	context.stroke();
	const [bx, by] = [-0.14 * (tangent[0] + normal[0]), -0.14 * (tangent[1] + normal[1])];
	label(context, 'B', sheet.x(px + bx), sheet.y(py + by), AXES.B);
	context.restore();
}

function label(context: CanvasRenderingContext2D, text: string, x: number, y: number, colour: string): void {
	context.lineJoin = 'round';
	context.strokeStyle = RIM;
	const { lineWidth } = context;
	context.lineWidth = 4;
	context.strokeText(text, x, y);
	context.lineWidth = lineWidth;
	context.fillStyle = colour;
	context.fillText(text, x, y);
}

function arrow(
	context: CanvasRenderingContext2D,
	...[x, y, toX, toY, colour, width]: [number, number, number, number, string, number]
): void {
	const long = Math.hypot(toX - x, toY - y) || 1;
	const [dx, dy] = [(toX - x) / long, (toY - y) / long];
	const head = 4.2 * width;
	const [neckX, neckY] = [toX - head * dx, toY - head * dy];
	context.fillStyle = colour;
	context.lineJoin = 'round';
	// With a dark rim, to be seen on any fur.
	for (const [stroke, wider] of [
		[RIM, 1.2 * width],
		[colour, 0],
	] as const) {
		context.strokeStyle = stroke;
		context.lineWidth = width + wider;
		context.beginPath();
		context.moveTo(x, y);
		context.lineTo(neckX, neckY);
		context.stroke();
		context.lineWidth = wider || 1;
		context.beginPath();
		context.moveTo(toX, toY);
		context.lineTo(neckX - 0.5 * head * dy, neckY + 0.5 * head * dx);
		context.lineTo(neckX + 0.5 * head * dy, neckY - 0.5 * head * dx);
		context.closePath();
		context.stroke();
		if (!wider) context.fill();
	}
}

/** Lamp around the joint, larger the nearer it is to the reader, and its ray to the vertex. */
function drawLamp(context: CanvasRenderingContext2D, sheet: Sheet, [lx, ly, lz]: Vector, [vx, vy]: Vector): void {
	const [x, y] = [sheet.x(LAMP * lx), sheet.y(LAMP * ly)];
	const size = (0.075 + 0.025 * lz) * sheet.unit;
	context.save();
	context.strokeStyle = LIGHT;
	context.lineWidth = 0.011 * sheet.unit;
	context.setLineDash([0.05 * sheet.unit, 0.04 * sheet.unit]);
	context.beginPath();
	context.moveTo(x, y);
	context.lineTo(sheet.x(vx), sheet.y(vy));
	context.stroke();
	context.restore();
	const glow = context.createRadialGradient(x, y, size * 0.6, x, y, size * 2.6);
	glow.addColorStop(0, 'rgb(255 217 160 / 55%)');
	glow.addColorStop(1, 'rgb(255 217 160 / 0%)');
	for (const [fill, radius] of [
		[glow, 2.6 * size],
		[LIGHT, size],
	] as const) {
		context.fillStyle = fill;
		context.beginPath();
		context.arc(x, y, radius, 0, 2 * Math.PI);
		context.fill();
	}
}
