/** A picture that is relit, as the stage shows it: upright, before the visitor, under the lamp that is dragged. */

import { Box3, type DirectionalLight, Mesh, PlaneGeometry, Quaternion, Vector3 } from 'three';
import { disposeAll } from '../../page/dispose.ts';
import { RelitMaterial } from '../../rti/RelitMaterial.ts';
import type { Relit } from '../../rti/relit.ts';
import type { Model } from '../../scene/model.ts';

/** First view: straight from the front, at which the picture is measured; first lamp: raking, from above left. */
const CAMERA: [number, number, number] = [0, 0, 1];
const LIGHT: [number, number, number] = [-0.55, 0.45, 0.7];

const direction = new Vector3();
const turn = new Quaternion();

/**
 * @param lamp that lights it; all others are left out: the picture knows one lamp at a time
 * @param largest side of a texture that the GPU takes
 */
export function relitModel(picture: Relit, lamp: DirectionalLight, largest: number): Model {
	const [width, height] = [picture.width, picture.height].map(
		(side) => (2 * side) / Math.max(picture.width, picture.height),
	);
	const material = new RelitMaterial(picture, largest);
	const object = new Mesh(new PlaneGeometry(width, height), material);
	object.onBeforeRender = () => {
		direction.subVectors(lamp.position, lamp.target.position).normalize();
		direction.applyQuaternion(object.getWorldQuaternion(turn).invert());
		material.light = [direction.x, direction.y, direction.z];
		material.uniformsNeedUpdate = true;
	};
	const box = new Box3().setFromObject(object);
	return {
		...{ object, box, fur: undefined },
		first: { camera: CAMERA, light: LIGHT },
		radius: box.getSize(new Vector3()).length() / 2,
		dispose: () => disposeAll(object),
	};
}
