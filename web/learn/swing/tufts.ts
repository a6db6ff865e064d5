/** Tufts of hair from the side, each bent by its spring. */

/** Largest displacement of tips, lengths of the hair: the library's limit. */
export const MAX_DISPLACEMENT = 0.8;

const HAIRS = 110;
/** Points along a hair. */
const POINTS = 12;
/** Longest hairs: share of the picture's height, and of a tuft's width. */
const [TALL, WIDE] = [0.78, 0.5];
/** Height of the skin, share of the picture's. */
const SKIN = 0.1;
/** Spread of roots to either side of the middle, lengths of the hair. */
const SPREAD = 0.34;
/** Radius of a hair at its root, lengths of the hair. */
const RADIUS = 0.013;
/** Colours from the shade between hairs to their tips. */
const SHADES = ['#3b2a1e', '#6d4d35', '#c39a70', '#e9cda6'];
const SKIN_COLOUR = '#33251c';

/** Fixed pseudo-random numbers between −1 and 1. */
function chance(i: number, salt: number): number {
	const x = Math.sin(i * 12.9898 + salt * 78.233) * 43758.5453;
	return 2 * (x - Math.floor(x)) - 1;
}

/** @param tips displacement of each tuft's tips, lengths of the hair; clamped to `MAX_DISPLACEMENT` */
export function drawTufts(canvas: HTMLCanvasElement, tips: readonly number[]): void {
	const context = canvas.getContext('2d');
	if (!context) return;
	const { width, height } = canvas;
	context.clearRect(0, 0, width, height);
	const room = width / tips.length;
	const longest = Math.min(TALL * height, WIDE * room);
	const ground = (height + longest) / 2 + SKIN * height * 0.5;
	// Outer hairs are lighter; those behind are shaded by those in front.
	const paints = [0.62, 0.8, 1].map((light) => {
		const paint = context.createLinearGradient(0, ground, 0, ground - longest * light);
		for (const [i, shade] of SHADES.entries()) paint.addColorStop(i / (SHADES.length - 1), shade);
		return paint;
	});
	tips.forEach((tip, n) => {
		const bent = Math.min(Math.max(tip, -MAX_DISPLACEMENT), MAX_DISPLACEMENT);
		for (let i = 0; i < HAIRS; i++) {
			const out = chance(i, 1);
			const lean = Math.min(Math.max(bent + 0.16 * out + 0.07 * chance(i, 2), -0.92), 0.92);
			const long = longest * (0.84 - 0.22 * out * out + 0.16 * chance(i, 3));
			context.fillStyle = paints[Math.floor((3 * (HAIRS - 1 - i)) / HAIRS)] ?? SKIN_COLOUR;
			hair(context, (n + 0.5) * room + SPREAD * out * longest, ground, lean, long, RADIUS * longest);
		}
	});
	context.fillStyle = SKIN_COLOUR;
	context.fillRect(0, ground, width, height - ground);
}

/** Draw one hair: it leaves along the normal and bends to its tip, as in the shells. */
function hair(
	context: CanvasRenderingContext2D,
	x: number,
	y: number,
	lean: number,
	long: number,
	radius: number,
): void {
	const rise = Math.sqrt(1 - lean * lean);
	const edge = (s: number, side: number) => {
		const [across, up] = [2 * lean * s, rise];
		const out = (side * radius * (1 - 0.85 * s)) / Math.hypot(across, up);
		context.lineTo(x + long * lean * s * s + up * out, y - long * rise * s + across * out);
	};
	context.beginPath();
	for (let i = 0; i <= POINTS; i++) edge(i / POINTS, -1);
	for (let i = POINTS; i >= 0; i--) edge(i / POINTS, 1);
	context.fill();
}
