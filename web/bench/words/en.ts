import type { Part } from '../../measure/bench/plan.ts';
import type { CostName, Method } from '../../measure/bench/results.ts';

const duration = (seconds: number) => (seconds < 90 ? `${Math.ceil(seconds)} s` : `${Math.round(seconds / 60)} min`);

const doing: Record<Part | 'loading', string> = {
	loading: 'loading the models',
	results: 'methods',
	layers: 'methods, triangles counted over all layers',
	costs: 'what features cost',
	curves: 'frames against shells and pixels',
	card: 'full pictures and herds',
};

const methods: Record<Method, string> = {
	unlit: 'unlit',
	lengyel: 'Lengyel',
	'shadow-layers': 'shadow layers',
	ptm: 'PTM',
	ptm3: 'PTM, 3 numbers',
	'ptm-colour': 'PTM as in the article: colours, no mean curves',
};

/** Names as the figures have them. */
const costs: Record<CostName, string> = {
	plain: 'plain',
	highlight: 'highlight',
	backlight: 'light from behind',
	shadow: 'shadow map',
	environment: 'environment',
	'all of them': 'all of them',
	'all of them, and fins': 'all of them, and fins',
	'one, moving': 'one lamp, moving',
	'a still light': 'a still light',
	'8 lights': '8 lights',
	fins: 'fins',
	'merged shells': 'hidden shells drawn as one',
	'48 shells': '48 shells',
	'48 shells, merged': '48 shells, hidden and faint ones merged',
};

export const en = {
	title: 'furbake · how fast',
	description:
		"The article's Table 1, measured on this very machine: fur by polynomial texture maps against its rivals.",
	heading: 'How fast is it?',
	intro:
		"The same fur, lit in six ways on the same torus, drawn in turn by the machine in front of you: 16 shells under one lamp that moves every frame, and nothing else. Unlit fur is the limit; shadow layers are the rival of the article's Table 1, in the form of deep opacity maps, redrawn whenever the light moves.",
	measured: 'What other machines have measured, and how',
	measure: 'Measure',
	again: 'Measure again',
	stop: 'Stop',
	measuring: 'Measuring …',
	done: 'Done: the figures are below.',
	stopped: 'Stopped.',
	quick: 'a quick look: fewer rounds, a quarter of the pixels',
	share: 'Share of the measurement that is done',
	download: 'Download as JSON',
	copy: 'Copy',
	copied: 'Copied',
	notCopied: 'The browser does not allow it',

	doing: (percent: number, secondsLeft: number | undefined, what: Part | 'loading') => {
		const left = secondsLeft === undefined ? '' : `, about ${duration(secondsLeft)} left`;
		return `${percent} %${left}: ${doing[what]}`;
	},
	machine: (device: string, cores: number, seconds: number, browser: string) =>
		`${device}, ${cores} cores by the browser’s word, ${duration(seconds)} in all. ${browser}`,
	failed: (why: string) => `It could not be measured: ${why}`,
	problems: (problems: string[]) => `In the address: ${problems.join('; ')}.`,
	problem: (given: string, expected: string) => `${given}: expected ${expected}`,
	expected: {
		rounds: '1 to 99',
		size: 'width and height, 16 to 9999 pixels, as in 1280x720',
		post: 'a path on this site',
		some: (all: readonly string[]) => `some of ${all.join(', ')}`,
	},

	methods,
	/** Title of a row of the table. */
	subject: (method: Method, still: boolean, fins: boolean) =>
		[methods[method], ...(still ? ['still light'] : []), ...(fins ? ['fins'] : [])].join(', '),
	picture: (subject: string) => `A furry torus, ${subject}`,
	costs,

	tables: {
		methods: 'Milliseconds a frame by triangles',
		layers: 'Milliseconds a frame by triangles of the body, of which 16 layers have 512, 4\u00a0608 and 16\u00a0896',
		milliseconds: (triangles: string) => `${triangles}: ms`,
		ofUnlit: 'of unlit',
		article: 'Frames per second by triangles',
		shadowLayers: 'shadow layers',
		ptm: 'PTM',
		faster: 'PTM is faster',
		theArticle: (triangles: string) => `${triangles}, the article`,
		here: (triangles: string) => `${triangles}, here`,
		hereOfLayers: (triangles: string) => `${triangles}, here, all layers together`,
		features: 'What fur can have besides',
		light: 'What light costs',
		ofPlain: 'of plain',
		ofOneLamp: 'of one lamp',
		overdraw: 'Fragments per covered pixel',
		covered: 'covered',
		shaded: 'shaded',
		blended: 'blended',
		triangles: (count: string, fins: boolean) => `${count} triangles${fins ? ', fins' : ''}`,
		card: 'Milliseconds a frame (frames per second) by picture',
		shells: (count: number, bodies: number) => `${count} shells, ${bodies === 1 ? 'one body' : `${bodies} bodies`}`,
	},

	methodsTitle: 'Methods',
	methodsText: (width: number, height: number, shells: number, rounds: number, reads: boolean) =>
		`Milliseconds a frame at ${width} × ${height} with ${shells} shells: the median of ${rounds === 1 ? 'one round' : `${rounds} rounds`} of turns there and back, each frame ended by ${reads ? 'reading a pixel of it' : "the GPU's own clock"}. Ratios are medians of the rounds' ratios.`,
	/** Sentence after those of `methodsText`. */
	growth: (steps: { from: string; to: string; ratio: string }[]) =>
		` A frame of PTM grows ${steps.map(({ from, to, ratio }) => `from ${from} to ${to} triangles ${ratio}`).join(', ')}.`,
	articleTitle: "The article's Table 1",
	articleText:
		"Frames per second. The article does not say whether its numbers of triangles are the body's or the sum over all 16 layers, so both are measured. Its machine was a Quadro NVS 110 with 64 MB, its rival a layered shadow map of which no text is to be had.",
	overdrawTitle: 'Overdraw',
	overdrawText:
		'Share of the picture that fur covers, and fragments there per pixel: shaded at the most (in front of the skin), and blended (above the alpha cut and not behind other fur).',
	costsTitle: 'What else costs what',
	costsText:
		'PTM with 4\u00a0608 triangles. First what fur can have besides, each by itself and all together, then what light costs: whether it moves, eight lamps for one, and fins.',
	cardTitle: 'Full pictures and herds',
	cardText: (device: string) =>
		`PTM with fins under one moving lamp, 4\u00a0608 triangles a body and shell, on ${device}: one body that fills the height, and a herd that does.`,
	curvesTitle: 'What a frame grows with',
	curvesText: 'Milliseconds a frame against the number of shells, of pixels and of triangles.',
	curves: {
		shells: ['Shells', 'shells'] as [title: string, axis: string],
		pixels: ['Pixels', 'million pixels'] as [title: string, axis: string],
		triangles: ['Triangles', 'triangles'] as [title: string, axis: string],
		unit: 'ms',
	},
};

export type Words = typeof en;
