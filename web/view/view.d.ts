/** `<fur-view>`: a furry model in any page, lit by dragging. Importing the module defines the element. */

/** Three numbers. */
export type Triple = [number, number, number];

/** What a view does: nothing yet, loading, showing its model, or saying why it cannot. */
export type FurViewState = 'idle' | 'loading' | 'ready' | 'failed';

/** Events of `<fur-view>`; none of them bubbles. */
export interface FurViewEventMap extends HTMLElementEventMap {
	/** The first whole picture of a model is in the page. */
	ready: Event;
	/** A visitor has moved the light. */
	lightchange: CustomEvent<{ light: Triple }>;
	/** Something that was asked for cannot be had; `message` says what, and the console unless the default is prevented. */
	error: ErrorEvent;
}

/** A furry model in the page. All properties but `state` and `clips` are attributes, too. */
export interface FurView extends HTMLElement {
	/** Address of a baked `model.gltf`, or of its folder. */
	src: string;
	/** Direction from the model to the lamp, world axes: x right, y up, z towards the first camera. */
	get light(): Triple;
	set light(direction: Triple | string);
	/** Azimuth and elevation in degrees, distance in units of the one at which the model fits. */
	get camera(): Triple;
	set camera(orbit: Triple | string);
	/** Fur to wear: a name of the list `models.json` beside the model's folder, or the address of a pelt. */
	preset: string;
	/** Clip to play; without one the model holds still. */
	clip: string;
	/** Whether the clip is held where it is; set by the view where a visitor wants less motion. */
	paused: boolean;
	/** Place around the model: studio, city, sky, sunset or forest; daylight without one. */
	environment: string;
	/** Whether lamp and buttons are shown. */
	controls: boolean;
	/** What the picture shows, for those who do not see it; the attribute without a text makes it decoration. */
	alt: string;
	/** What the view does. */
	readonly state: FurViewState;
	/** Names of the model's clips. */
	readonly clips: readonly string[];
	/** Brings light and camera back to where the page has put them. */
	reset(): void;
	addEventListener<K extends keyof FurViewEventMap>(
		type: K,
		listener: (this: FurView, event: FurViewEventMap[K]) => unknown,
		options?: boolean | AddEventListenerOptions,
	): void;
	addEventListener(
		type: string,
		listener: EventListenerOrEventListenerObject,
		options?: boolean | AddEventListenerOptions,
	): void;
	removeEventListener<K extends keyof FurViewEventMap>(
		type: K,
		listener: (this: FurView, event: FurViewEventMap[K]) => unknown,
		options?: boolean | EventListenerOptions,
	): void;
	removeEventListener(
		type: string,
		listener: EventListenerOrEventListenerObject,
		options?: boolean | EventListenerOptions,
	): void;
}

/** Class of the element. */
export declare const FurView: { new (): FurView; prototype: FurView };

declare global {
	interface HTMLElementTagNameMap {
		'fur-view': FurView;
	}
}
