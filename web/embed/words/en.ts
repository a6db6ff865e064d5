export const en = {
	title: 'furbake · fur in your page',
	description: 'One tag puts relightable fur into any page: a file, a folder and a line of HTML.',
	heading: 'Fur in your page, by one tag',
	intro: 'Drag over the bunny: the light follows, and so does the tag below. Copy it once you like what you see.',
	tryLabel: 'Try it',
	preset: 'Fur',
	own: 'its own',
	environment: 'Place',
	none: 'daylight',
	controls: 'Lamp and buttons',
	howHeading: 'Three steps',
	stepFile:
		'Put this file onto your server. All that is needed is in it, three.js too; it asks no other host for anything.',
	size: (kilobytes: number) => `${kilobytes} kB, as this host sends it`,
	stepFolder:
		'Put a baked folder beside it: one of the models of this site, or your own model in fur. Each tag says below what it wants beside your page; copy folders whole, from public/models of furbake.',
	files: (names: string) => `Beside your page: ${names}`,
	stepTag: 'Write two lines into your page.',
	galleryHeading: 'Gallery',
	galleryIntro: 'Each has its own light: drag it. All share one WebGL context, and what nobody sees is not drawn.',
	bunny: 'A furry bunny under a lamp',
	fox: 'A bunny in the fur of a fox',
	sheep: 'A bunny in wool, under the sky',
	wolf: "A bunny in a wolf's coat, at sunset",
	torus: 'A furry ring in a studio',
	teddy: 'A plush bunny in the city, close up',
	mole: "A bunny in a mole's velvet, in the forest",
	more: 'Attributes, properties, events, slots, and what a content security policy has to allow:',
	docs: 'the tag in the docs',
	copy: 'Copy this',
	copied: 'Copied',
	notCopied: 'The browser does not allow it',
	/** Words of a button with the picture that it is for. */
	about: (said: string, picture: string) => `${said}: ${picture}`,
	presets: { bunny: 'bunny', fox: 'fox', wolf: 'wolf', sheep: 'sheep', teddy: 'teddy', mole: 'mole' } as Record<
		string,
		string
	>,
	places: { studio: 'studio', city: 'city', sky: 'sky', sunset: 'sunset', forest: 'forest' } as Record<string, string>,
};

/** Words of one language. */
export type Words = typeof en;
