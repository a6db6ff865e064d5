import { loadFurry, reach } from '../assets.ts';
import type { Mount } from '../lesson.ts';
import { View } from '../view.ts';

export const mount: Mount = async (place, lesson) => {
	const furry = await loadFurry('bunny', lesson);
	const view = new View(place, lesson, { label: 'x', elevation: 8, ...reach(furry) });
	view.add(furry.object);
	view.cast(furry.fur);
};
