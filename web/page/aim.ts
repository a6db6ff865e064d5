/** Direction of the light under a finger. */

import { type Camera, MathUtils, Ray, Vector2, Vector3 } from 'three';

/** Radii from the sphere's middle at which the lamp is straight behind the model. */
const behind = 1.6;

const ray = new Ray();
const onRay = new Vector3();

/**
 * Direction of the lamp under a finger. The lamp is on a sphere around the model: exactly under the finger on the near side
 * within the sphere's rim, on the far side beyond it.
 *
 * @param pointer in normalised device coordinates, -1..1, y up
 * @param centre of the sphere, world
 * @param radius of the sphere
 * @param target takes the unit direction from centre to lamp, world axes
 */
export function directionUnder(
	pointer: Vector2,
	camera: Camera,
	centre: Vector3,
	radius: number,
	target: Vector3,
): Vector3 {
	ray.origin.setFromMatrixPosition(camera.matrixWorld);
	ray.direction.set(pointer.x, pointer.y, 0.5).unproject(camera).sub(ray.origin).normalize();
	ray.closestPointToPoint(centre, onRay);
	const away = onRay.distanceTo(centre);
	const out = target.subVectors(onRay, centre).divideScalar(radius);
	if (away <= radius) return out.addScaledVector(ray.direction, -Math.sqrt(1 - out.lengthSq())).normalize();
	const left = MathUtils.clamp(1 - (away / radius - 1) / (behind - 1), 0, 1);
	return out
		.setLength(left)
		.addScaledVector(ray.direction, Math.sqrt(1 - left * left))
		.normalize();
}

/** Callbacks of drags. */
export interface DragHandlers {
	/** pointer in normalised device coordinates */
	move(pointer: Vector2): void;
	/** Whether drags may move the light now. */
	allowed(): boolean;
	active(active: boolean): void;
}

const patience = 90; // milliseconds within which a second finger cancels a drag
const slack = 6; // pixels before a touch becomes a drag

/** Drags of the left button, a pen or one finger on the canvas; two fingers are for the camera. */
export function listenToDrags(canvas: HTMLCanvasElement, { move, allowed, active }: DragHandlers): void {
	const fingers = new Set<number>();
	const pointer = new Vector2();
	let dragging: number | undefined;
	let waiting: { id: number; x: number; y: number; timer: ReturnType<typeof setTimeout> } | undefined;

	const follow = (x: number, y: number) => {
		const { left, top, width, height } = canvas.getBoundingClientRect();
		move(pointer.set(((x - left) / width) * 2 - 1, 1 - ((y - top) / height) * 2));
	};
	const begin = (id: number, x: number, y: number) => {
		stopWaiting();
		dragging = id;
		active(true);
		follow(x, y);
	};
	const stopWaiting = () => {
		clearTimeout(waiting?.timer);
		waiting = undefined;
	};
	const end = () => {
		if (dragging === undefined) return;
		dragging = undefined;
		active(false);
	};

	canvas.addEventListener('pointerdown', (event) => {
		const { pointerId: id, pointerType, clientX: x, clientY: y } = event;
		if (pointerType === 'touch') fingers.add(id);
		if (event.button !== 0 || !allowed()) return;
		if (fingers.size > 1) {
			stopWaiting();
			end();
		} else if (pointerType === 'touch') {
			waiting = { id, x, y, timer: setTimeout(() => begin(id, x, y), patience) };
		} else {
			canvas.setPointerCapture(id);
			begin(id, x, y);
		}
	});
	canvas.addEventListener('pointermove', ({ pointerId, clientX, clientY }) => {
		if (pointerId === waiting?.id && Math.hypot(clientX - waiting.x, clientY - waiting.y) > slack)
			begin(pointerId, clientX, clientY);
		else if (pointerId === dragging) follow(clientX, clientY);
	});
	canvas.addEventListener('pointerup', ({ pointerId, clientX, clientY }) => {
		// A tap is a drag of length 0.
		if (pointerId === waiting?.id) begin(pointerId, clientX, clientY);
	});
	for (const name of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
		canvas.addEventListener(name, ({ pointerId }) => {
			fingers.delete(pointerId);
			if (pointerId === waiting?.id) stopWaiting();
			if (pointerId === dragging) end();
		});
	}
}
