/** What all views of a page share: one WebGL context, its frames and the backdrop. */

import type { DataTexture } from 'three';
import { backdrop } from '../page/backdrop.ts';
import { Painter } from '../scene/Painter.ts';

/** A view as far as frames are concerned. */
export interface Drawn {
	/** Moves on by some seconds, and asks for a redraw where that shows. @returns whether it moves on */
	step(elapsed: number): boolean;
}

/** Painter, frames and backdrop of the views that are in the page. */
export interface Shared {
	readonly painter: Painter;
	readonly backdrop: DataTexture;
}

let shared: Shared | undefined;
const views = new Set<Drawn>();

/** Joins the views of the page; the first opens the context. */
export function join(view: Drawn): Shared {
	views.add(view);
	if (shared) return shared;
	// Views out of the window are not drawn.
	const painter = new Painter('0px');
	shared = { painter, backdrop: backdrop(true) };
	painter.animate((elapsed) => {
		let moving = false;
		for (const view of views) if (view.step(elapsed)) moving = true;
		return moving;
	});
	return shared;
}

/** Leaves the views of the page; the last closes the context. */
export function leave(view: Drawn): void {
	views.delete(view);
	if (views.size > 0 || !shared) return;
	shared.backdrop.dispose();
	shared.painter.dispose();
	shared = undefined;
}
