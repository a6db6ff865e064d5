/** Colours of pictures: means in linear light, hue, CIE L*a*b*, and the pixels of fur. */

/**
 * @typedef {object} Pixels
 * @property {number} width
 * @property {number} height
 * @property {number} channels
 * @property {ArrayLike<number>} data sRGB bytes, row by row from the top
 */

/** @typedef {[red: number, green: number, blue: number]} Colour linear, white 1 */

/** @param {number} code sRGB, 0 to 255 */
const linear = (code) => (code <= 10.31475 ? code / 3294.6 : ((code / 255 + 0.055) / 1.055) ** 2.4);

/** @param {Pixels} picture; @param {number} pixel; @returns {Colour} */
function colourAt({ data, channels }, pixel) {
	const [red, green, blue] = [0, 1, 2].map((c) => linear(data[pixel * channels + c]));
	return [red, green, blue];
}

/**
 * Mean colour of the given pixels.
 *
 * @param {Pixels} picture
 * @param {readonly number[]} pixels their indices
 * @returns {Colour}
 */
export function meanColour(picture, pixels) {
	const sum = [0, 0, 0];
	for (const pixel of pixels) for (const [c, value] of colourAt(picture, pixel).entries()) sum[c] += value;
	const [red, green, blue] = sum.map((value) => value / pixels.length);
	return [red, green, blue];
}

/**
 * Hue and saturation of the hexcone (HSV) of a linear colour.
 *
 * @param {Colour} colour
 * @returns {{ hue: number, saturation: number }} degrees; 0..1
 */
export function hueOf([red, green, blue]) {
	const most = Math.max(red, green, blue);
	const range = most - Math.min(red, green, blue);
	if (range === 0) return { hue: 0, saturation: 0 };
	let turn = (red - green) / range + 4;
	if (most === red) turn = (green - blue) / range;
	else if (most === green) turn = (blue - red) / range + 2;
	return { hue: (60 * turn + 360) % 360, saturation: range / most };
}

/** Difference of two hues, −180 to 180 degrees. @param {number} a; @param {number} b */
export const hueApart = (a, b) => ((((a - b + 180) % 360) + 360) % 360) - 180;

/** @param {Colour} colour; @returns {[number, number, number]} CIE L*a*b* under D65 */
function lab([r, g, b]) {
	const curve = (/** @type {number} */ t) => (t > 216 / 24389 ? Math.cbrt(t) : (24389 / 27 / 116) * t + 16 / 116);
	const x = curve((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047);
	const y = curve(0.2126729 * r + 0.7151522 * g + 0.072175 * b);
	const z = curve((0.0193339 * r + 0.119192 * g + 0.9503041 * b) / 1.08883);
	return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

/** Distance of two colours in CIE L*a*b* (ΔE of 1976). @param {Colour} a; @param {Colour} b */
export function deltaE(a, b) {
	const other = lab(b);
	return Math.hypot(...lab(a).map((value, i) => value - other[i]));
}

/**
 * Pixels of lit fur: those that change with the colour of the hairs.
 *
 * @param {Pixels} picture
 * @param {Pixels} recoloured the same view, its hairs in another colour
 * @returns {number[]} their indices
 */
export function litFur(picture, recoloured) {
	const LEAST = 16; // steps of 255: more than unlit fur and the ground that shines through
	const found = [];
	for (let pixel = 0; pixel < picture.width * picture.height; pixel++) {
		const at = pixel * picture.channels;
		const apart = [0, 1, 2].map((c) =>
			Math.abs(picture.data[at + c] - recoloured.data[pixel * recoloured.channels + c]),
		);
		if (Math.max(...apart) >= LEAST) found.push(pixel);
	}
	return found;
}

/** Pixels of a disc in the middle. @param {Pixels} picture; @param {number} radius in halves of the height */
export function middleDisc({ width, height }, radius) {
	const found = [];
	for (let y = 0; y < height; y++)
		for (let x = 0; x < width; x++)
			if (Math.hypot(x + 0.5 - width / 2, y + 0.5 - height / 2) < (radius * height) / 2) found.push(y * width + x);
	return found;
}

/** Share of pixels with a channel at its end. @param {Pixels} picture; @param {readonly number[]} pixels */
export function clipped({ data, channels }, pixels) {
	const full = pixels.filter((pixel) => [0, 1, 2].some((c) => data[pixel * channels + c] >= 255));
	return full.length / pixels.length;
}
