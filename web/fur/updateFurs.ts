/** Parts of a fur that change from frame to frame, in the order of their updates: maps of a method show motion and weather. */
const PARTS = ['motion', 'weather', 'method'] as const;

/** Part of a fur that is updated once per frame. */
interface Part {
	/** @internal */
	update(seconds: number): boolean;
}

/** Fur, as far as it is updated. */
type Updated = Readonly<Record<(typeof PARTS)[number], Part | undefined>>;

const done = new Set<Part>();

/**
 * Advances motion, weather and maps of furs by a frame: each once, however many of the furs share it. Call it once per frame,
 * before drawing.
 *
 *     if (updateFurs([fox, wolf], clock.getDelta())) renderer.render(scene, camera);
 *
 * @param seconds since the last frame; 0 shows changed settings without advancing
 * @returns whether the picture changes
 */
export function updateFurs(furs: readonly Updated[], seconds: number): boolean {
	let changed = false;
	for (const name of PARTS)
		for (const { [name]: part } of furs) {
			if (!part || done.has(part)) continue;
			done.add(part);
			if (part.update(seconds)) changed = true;
		}
	// Clearing makes a new table.
	if (done.size > 0) done.clear();
	return changed;
}
