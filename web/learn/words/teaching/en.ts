/** Words of the opening, of the parabola by hand, of means over neighbours and of the questions. */

export const teaching = {
	hello: 'A square of fox fur. Drag or use the arrow keys to move the light.',
	hair: {
		sketch: 'Lamp on its arc over a sketch of fur. Drag, or use the arrow keys, to carry it.',
		degrees: (degrees: string) => `${degrees}° from upright`,
		plot: 'Brightness of the spot by where the lamp is: dots as measured, a parabola on three handles.',
		handles: ['Left handle', 'Middle handle', 'Right handle'],
		across: 'lᵥ, the lamp along the skin',
		up: 'L',
		best: 'Show the best parabola',
		hide: 'Hide the best parabola',
		says: ([square, linear, constant]: readonly string[], own: string, best: string) =>
			`Yours: L = ${square}·lᵥ² + ${linear}·lᵥ + ${constant}, off by ${own} (root of the mean squared error)`.replaceAll(
				'+ −',
				'− ',
			) + (best ? `; the best is off by ${best}.` : '.'),
	},
	mean: {
		measured: (high: string) => `measured, by a lamp ${high}° high that no fit saw`,
		relit: 'by six numbers',
		off: (times: number) => `six numbers − measured, × ${times}`,
		offNow: (times: number, all: string, own: string) =>
			`six numbers − measured, × ${times}. This lamp: ${all} % off, ${own} % without what the layer shares`,
		worst: 'Lamp of the largest shared error',
		side: 'Averaged over',
		square: (side: number) => `${side} × ${side}`,
		shared: 'Error that the layer shares',
		sharing: { kept: 'left in', taken: 'taken out' },
		plot: 'Errors in per cent of the layer’s mean light, by the side of the squares averaged over.',
		percent: 'error, % of the mean light',
		all: 'all of the error',
		own: 'without what the layer shares',
		says: (side: number, all: string, own: string) =>
			`Over ${side} × ${side} texels, all held-out lamps: ${all} % off, ${own} % without what the whole layer shares.`,
	},
	pose: {
		picture:
			'A furry limb of two bones, with the frame of one vertex before and after. Drag, or use the arrow keys, to turn the joint.',
		bars: 'The six light moments of the vertex, before and after the joint has turned.',
		columns: ['before', 'now'] as [string, string],
		joint: 'Joint',
		degrees: (degrees: string) => `${degrees}°`,
		says: (before: string, now: string) =>
			`Times the six numbers of figure 4’s patch: L = ${before} before, ${now} now.`,
	},
	ask: {
		dome: {
			ask: 'Predict: when the lamp sinks from above to the horizon, which layer loses the larger share of its light?',
			answers: ['layer 4, near the roots', 'layer 14, near the tips', 'both the same'],
			right: 'Yes.',
			wrong: 'No.',
			because: (deep: string, high: string) =>
				`Layer 4 loses ${deep} % of its light, layer 14 ${high} %: a low lamp’s rays cross more hairs, and most on the way to the roots.`,
		},
		bits: {
			ask: 'Predict: eight bits are stored. Down to how many can you go before rounding costs half a decibel?',
			answers: ['seven', 'six', 'four'],
			right: 'Yes.',
			wrong: 'Fewer than you think.',
			because: (bits: number, now: string, all: string) =>
				`At ${bits} bits the layers still have ${now} dB of ${all}: what the polynomial itself gets wrong is far larger.`,
		},
		nap: {
			ask: 'Predict: from where does the plush look brighter than from straight above?',
			answers: ['beside the lamp', 'opposite the lamp', 'from neither'],
			right: 'Yes.',
			wrong: 'No.',
			because: (beside: string, opposite: string) =>
				`Beside the lamp light counts × ${beside}, opposite × ${opposite}: there you look at the hairs’ unlit sides.`,
		},
	},
};
