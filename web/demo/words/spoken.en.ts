/** Words for those who do not see the picture; fetched after it. */

export const en = {
	/** Name of the picture. */
	shown: (model: string) => `${model}, under a lamp that you move`,
	nothing: 'Nothing is on show',
	/** Said when another model has come. */
	arrived: (model: string) => `${model} is on show.`,
	keys: 'Arrow keys move the lamp, with Shift further. Plus and minus come nearer and go away. With the camera’s button pressed arrow keys turn the camera. With a brush they move its ring, and Enter strokes or paints there.',
	lamp: (aside: string, up: string) => `Lamp ${aside}, ${up}`,
	camera: (aside: string, up: string, distance: string) => `Camera ${aside}, ${up}, distance ${distance}`,
	/** Seen from the camera; the camera, from the front of the model. */
	right: (degrees: number) => `${degrees}° to the right`,
	left: (degrees: number) => `${degrees}° to the left`,
	front: 'in front',
	behind: 'behind',
	above: (degrees: number) => `${degrees}° up`,
	below: (degrees: number) => `${degrees}° below`,
	painted: { stroke: 'Stroked', rain: 'Rained on', mud: 'Soiled' } as Partial<Record<string, string>>,
};
