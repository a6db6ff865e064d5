import { teaching } from './teaching/en.ts';
import { whole } from './whole.ts';

/** Numbers per texel with their decibels, and the polynomial's terms. */
interface NumbersSaid {
	count: number;
	terms: readonly string[];
	ptm: string;
	eigen: string;
	best: string;
}

interface BodyNumbers {
	skin: number;
	patches: number;
	faces: number;
	overlap: number;
	fins: number;
}

/** Share in per cent, to a tenth where it has one. */
const percent = (share: number) => `${Number((100 * share).toFixed(1))} %`;

export const en = {
	...teaching,
	title: 'furbake · how light gets into fur',
	description:
		'A lesson in one scroll: fur in real time by polynomial texture maps, every figure live under one light.',
	steps: 'Steps of the lesson',
	print: 'Print, with all figures',
	hold: 'Hold light and wind',
	/** Name of a figure: its step, and which of the step's figures it is. */
	figure: (step: string, number: number, of: number) => (of > 1 ? `${step}, ${number} of ${of}` : step),
	draw: (figure: string) => `Draw the figure: ${figure}`,
	needsWebGL2: 'This figure is drawn live and needs WebGL2, which this browser does not offer.',
	failed: (reason: string) => `This figure cannot be shown: ${reason}`,
	shells: {
		above: 'A square of fur seen from above at an angle. Drag or use the arrow keys to move the light.',
		side: 'The same fur seen from its edge.',
		slider: 'Shells',
		count: (shells: number) => String(shells),
	},
	slices: {
		picture: 'One tile of fur. Drag or use the arrow keys to move the light.',
		stage: 'Show',
		stages: { strands: 'strands', volume: 'volume', slices: 'slices' },
		apart: 'Pull apart',
		times: (times: number) => `× ${times.toFixed(1)}`,
		strands: (count: number) => `${count} strands in one periodic tile`,
		volume: (size: number, layers: number, shown: number, solid: number) =>
			`${size} × ${size} × ${layers} voxels; the ${shown} that hair covers by more than ${Math.round(100 * solid)} % are shown`,
		slices: (layers: number, size: number, coefficients: number) =>
			`${layers} slices of ${size} × ${size} texels, ${coefficients} coefficients and α in each`,
	},
	body: {
		picture: 'A furry bunny. Drag or use the arrow keys to move the light.',
		show: 'Show',
		parts: {
			fur: 'shells and fins',
			shells: 'shells alone',
			fins: 'fins alone',
			patches: 'a colour per patch',
			hull: 'hull',
		},
		numbers: ({ skin, patches, faces, overlap, fins }: BodyNumbers) =>
			`${whole(skin)} triangles of skin · ${patches} patches, in all of ${whole(faces)} triangles, ` +
			`${overlap.toFixed(2)} per triangle of skin · ${whole(fins)} triangles of fins`,
	},
	nap: {
		pictures: [
			'A disc of plush with the factor of light and eye. Drag to turn the eye, or drag the lamp; arrow keys move the lamp.',
			'The same without the factor. Drag to turn the eye, or drag the lamp; arrow keys move the lamp.',
		],
		captions: [
			(factor: string) => `with the factor: light counts × ${factor} for this eye`,
			() => 'without: as from straight above',
		],
		around: 'Eye, around',
		height: 'Eye, height',
		degrees: (degrees: number) => `${degrees}°`.replace('-', '−'),
		fromLean: (degrees: number) => `${degrees}° from the lean`.replace('-', '−'),
		aroundPlot: 'The factor for eyes all around the fur at this height, as a curve; lamp, eye and lean are marked.',
		aroundName: 'Once around, seen from above; the arrow is the hairs’ lean',
		overPlot: 'The factor for eyes from horizon to horizon in the plane of this eye; lamp and eye are marked.',
		overName: 'Over the fur, in the plane of the eye',
		curve: 'factor, by where the eye is',
		one: '1: as from straight above',
		lamp: 'lamp',
		eye: 'eye',
	},
	rivals: {
		picture: (method: string) => `A furry ring, lit by ${method}. Drag or use the arrow keys to move the light.`,
		methods: {
			unlit: { name: 'Unlit', costs: 'Colour alone: the limit that no light can be cheaper than.' },
			lengyel: {
				name: 'Lengyel',
				costs: 'Light of each hair by itself, one direction fetched per fragment; shadow is a guess by depth.',
			},
			'shadow-layers': {
				name: 'Shadow layers',
				costs: 'Shadow of hairs on hairs; the whole fur is drawn again from the lamp whenever it moves.',
			},
			ptm: { name: 'PTM', costs: 'Shadow of hairs on hairs; two fetches and one dot product, wherever the lamp is.' },
			article: {
				name: 'PTM as in the article',
				costs:
					'The polynomial alone, without mean curves. A third fetch gives each hair its own colour, many paler ' +
					'than the one that all hairs have in the other pictures.',
			},
		},
		lamp: 'Lamp',
		lamps: {
			above: 'from above',
			side: 'low, from the side',
			behind: 'low, behind the ring',
			eye: 'beside the eye',
		},
		truth: {
			name: 'Path-traced',
			picture: (lamp: string) => `The ring’s very hairs, path-traced under a lamp ${lamp}.`,
			costs: 'The truth: every hair by itself, 256 light paths per pixel, minutes per picture.',
			elsewhere: 'The truth, for the four lamps below alone: choose one.',
		},
		table:
			'Table 1: frames per second; 16 shells, light moving. Here triangles are those of the body; the article does not ' +
			'tell whether its are.',
		article: 'The article, 2009',
		here: 'This machine, now',
		triangles: 'Triangles',
		columns: ['layers', 'PTM', 'ratio'],
		count: whole,
		measure: 'Measure here',
		stop: 'Stop',
		stopped: 'Stopped.',
		measuring: (share: number) => `Measuring … ${Math.round(100 * share)} %`,
		measured: 'Measured at 640 × 360 pixels, in turn. The Bench page measures longer and more.',
		cannot: (reason: string) => `Cannot be measured: ${reason}`,
	},
	tuft: {
		picture: 'A tuft of long fur on a plane and its shadow. Drag or use the arrow keys to move the light.',
	},
	turning: {
		picture: (turn: number) =>
			`A square of fur, the light turned by ${turn} degrees. Drag or use the arrow keys to move it.`,
		brightness: (turn: number, brightness: number) => `${turn}°: mean L = ${brightness.toFixed(2)}`,
	},
	short: {
		pictures: [
			'Long fur. Drag or use the arrow keys to move the light.',
			'Short fur. Drag or use the arrow keys to move the light.',
		],
		swing: (height: number, swing: number) =>
			`Height ${height} of a tile: once around, L swings by ± ${(100 * swing).toFixed(0)} %.`,
	},
	spring: {
		tufts:
			'Three tufts of hair on the same spring: as it truly swings, by the exact step, by Euler’s. ' +
			'Drag, or use the arrow keys, to push them aside and let them go.',
		ways: ['true swing', 'exact step', 'Euler’s step'],
		plot: 'Where the tips are during two seconds: the true curve, points of the exact step, points of Euler’s.',
		seconds: 'seconds',
		lengths: 'tip, in lengths of the hair',
		step: 'Time step',
		rate: (rate: number) => `1/${rate} s`,
		frequency: 'Frequency',
		hertz: (hertz: string) => `${hertz} Hz`,
		damping: 'Damping ζ',
		letGo: 'Let go',
		off: (exact: string, euler: string, limit: string) =>
			`Off the curve at most: exact step ${exact}, Euler’s ${euler} lengths of the hair. ` +
			`Euler’s is bounded up to steps of 2ζ/ω = ${limit} ms.`,
	},
	wind: {
		picture: 'A square of fur in the wind. Drag to stroke it; arrow keys move the light.',
		wind: 'Wind',
		strength: (strength: number) => `${percent(strength)} of a storm`,
		direction: 'Blows to',
		degrees: (degrees: number) => `${degrees}°`,
		stroke: 'Stroke it',
		shake: 'Shake it',
	},
	wet: {
		picture: 'A square of fur between two states. Drag or use the arrow keys to move the light.',
		neighbours: [
			'The drier of the two states. Drag or use the arrow keys to move the light.',
			'The wetter of the two states. Drag or use the arrow keys to move the light.',
		],
		states: ['dry', 'damp', 'moist', 'wet', 'soaked'],
		share: (state: string, share: number) => `${(100 * share).toFixed(0)} % ${state}`,
		wetness: 'Wetness',
		dirt: 'Dirt',
		amount: percent,
		hair: (length: number, shade: number) =>
			`Hairs stand ${(100 * length).toFixed(0)} % as high as dry ones, and are ${(100 * shade).toFixed(0)} % as bright.`,
	},
	/** Figures on sampling, fit, bytes and numbers per texel. */
	measured: {
		layerOf: (layers: number) => `Layer, of ${layers}`,
		dark: 'dark',
		bright: 'bright, L =',
		dome: 'Dome of lamps over a patch of fur. Drag, or use the arrow keys, to light another lamp.',
		lamp: (number: number, of: number, high: string) => `Lamp ${number} of ${of}, ${high}° above the skin.`,
		heldOut: (number: number, of: number, high: string) =>
			`Lamp ${number} of ${of} that the fit never sees, ${high}° above the skin.`,
		lampOfFit: 'lamp of the fit',
		lampHeldOut: 'held out, to judge by',
		measuredUnder: (high: string, mean: string) => `as measured: lamp ${high}° high, mean L ${mean}`,
		measuredSlice: 'The layer as measured under that lamp, seen from above.',
		moveLight: 'Drag or use the arrow keys to move the light.',
		pickTexel: 'The layer as measured. Click, or use the arrow keys, to choose a texel.',
		texelAt: (column: number, row: number) => `texel (${column}, ${row})`,
		disc: 'The texel’s polynomial over the disc of lights, and what was measured, as dots.',
		discSays: (value: string) => `L over (lᵤ, lᵥ): the ground is the polynomial, ${value} now; dots were measured`,
		surface: 'The polynomial as a surface over (lᵤ, lᵥ), and sticks from it to what was measured.',
		above: 'measured above the surface',
		below: 'below it',
		term: 'term',
		exact: 'a, fitted',
		byte: 'byte a′',
		decoded: 'λ(a′ − Ω)',
		/** Beside the value of the formula, in brackets. */
		beside: (bytes: string, measured: string, away: string) => [
			`(from the bytes ${bytes};`,
			`measured ${measured}, by a lamp ${away}° off)`,
		],
		texelError: (fit: string, unseen: string) =>
			`Root of the mean squared error: ${fit} over the lamps of the fit, ${unseen} over those held out.`,
		singular: 'singular values of the light matrix, 64 × 6',
		condition: (value: string) => `largest / smallest = ${value}: no number of the six is left to chance.`,
		bits: 'bits per number',
		unrounded: 'six numbers, not rounded',
		rounded: (bits: number) => `six numbers of ${bits} bits`,
		noise: 'their difference × 8',
		relit: (what: string) => `The layer relit: ${what}.`,
		noiseNow: (db: string) => `their difference × 8: ${db} dB here and now`,
		noiseCurve: 'Decibels by bits per number: rounding alone, and all errors together.',
		noiseLine: 'rounding alone',
		wholeLine: 'rounding and fit, on held-out lamps',
		atBits: (bits: number, bytes: string, psnr: string, noise: string) =>
			`All layers, ${bits} bits or ${bytes} bytes a texel: ${psnr} dB against what was measured, ${noise} dB against the unrounded numbers.`,
		lambda: 'λ',
		omega: 'Ω',
		numbersOf: 'Numbers per texel',
		measured: 'measured, by a lamp that no fit saw',
		ptmPanel: (db: string) => `PTM: ${db} dB under this lamp`,
		eigenPanel: (db: string) => `eigen: ${db} dB under this lamp`,
		ptmOff: 'PTM − measured, × 2',
		eigenOff: 'eigen − measured, × 2',
		differs: 'Orange: brighter than measured. Blue: darker. Grey: right.',
		arc: 'Light of the chosen texel while a lamp goes over the fur.',
		arcAxis: 'lamp, degrees from upright, along v',
		ptm: 'PTM',
		eigen: 'eigen',
		best: 'any numbers at best',
		measuredMark: 'measured',
		byNumbers: 'Decibels by numbers per texel, on held-out lamps.',
		numbersAxis: 'numbers per texel',
		atNumbers: ({ count, terms, ptm, eigen, best }: NumbersSaid) =>
			`All layers, ${count} numbers a texel, not rounded: PTM ${ptm} dB, eigen ${eigen} dB, at best ${best} dB. ` +
			`Terms of the PTM: ${terms.join(', ')}.`,
		decibels: 'dB',
		light: 'L',
	},
};

export type Words = typeof en;
