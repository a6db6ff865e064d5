import type { DirectionalLight, Object3D } from 'three';

let found: DirectionalLight | undefined;
const find = (object: Object3D): void => {
	if ((object as DirectionalLight).isDirectionalLight) found ??= object as DirectionalLight;
};

/** First visible directional light of an object's scene. */
export function firstLamp(object: Object3D): DirectionalLight | undefined {
	let top = object;
	while (top.parent) top = top.parent;
	found = undefined;
	top.traverseVisible(find);
	return found;
}
