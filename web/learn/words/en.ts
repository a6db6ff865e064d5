export const en = {
	title: 'furbake · how light gets into fur',
	description:
		'A lesson in one scroll: fur in real time by polynomial texture maps, every figure live under one light.',
	steps: 'Steps of the lesson',
	needsWebGL2: 'This figure is drawn live and needs WebGL2, which this browser does not offer.',
	failed: (reason: string) => `This figure cannot be shown: ${reason}`,
};
