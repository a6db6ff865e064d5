/** Properties of `<fur-view>` that are attributes of the same name. */

import { format, type Triple } from './attributes.ts';

export const TEXTS = ['src', 'preset', 'clip', 'environment', 'alt'] as const;
export const SWITCHES = ['controls', 'paused'] as const;
export const TRIPLES = ['light', 'camera'] as const;

/** Sets an attribute as a property does: frameworks hand over whatever they have. */
export function set(view: HTMLElement, name: string, value: Triple | string | null | undefined): void {
	if (value === null || value === undefined) view.removeAttribute(name);
	else view.setAttribute(name, typeof value === 'string' ? value : format(value));
}

/** Defines the properties of texts and switches. */
export function defineProperties(prototype: HTMLElement): void {
	for (const name of TEXTS)
		Object.defineProperty(prototype, name, {
			configurable: true,
			enumerable: true,
			get(this: HTMLElement) {
				return this.getAttribute(name) ?? '';
			},
			set(this: HTMLElement, value: string) {
				set(this, name, value);
			},
		});

	for (const name of SWITCHES)
		Object.defineProperty(prototype, name, {
			configurable: true,
			enumerable: true,
			get(this: HTMLElement) {
				return this.hasAttribute(name);
			},
			set(this: HTMLElement, value: boolean) {
				this.toggleAttribute(name, Boolean(value));
			},
		});
}
