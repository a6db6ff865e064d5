/** Camera that orbits the model, and fits it into a room of any shape in the picture. */

import {
	Box2,
	MathUtils,
	Mesh,
	MOUSE,
	type Object3D,
	PerspectiveCamera,
	Spherical,
	TOUCH,
	Vector2,
	Vector3,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { Room } from '../../page/room.ts';
import { framedRadius } from '../../scene/framed.ts';
import type { Model } from '../../scene/model.ts';
import type { Triple } from '../state/view.ts';

const FIELD_OF_VIEW = 26; // degrees, of the window's height
const MIN_DISTANCE = 0.25; // in units of the distance at which the model fits
/** The same from a point aside of the model's middle, such as a paw. */
const MIN_DISTANCE_ASIDE = 0.05;
const MAX_DISTANCE = 4;

/** Body or crowd that the camera is fitted to. */
export interface Framed {
	centre: Vector3;
	/** Radius of the sphere that is fitted in: of the body, or of the middle of a crowd. */
	radius: number;
	bodyRadius: number;
	/** Longest hairs as they were baked: those that a visitor makes longer do not move the camera. */
	furLength: number;
	model: Pick<Model, 'box'> | undefined;
}

const offset = new Vector3();
const point = new Vector3();
const spherical = new Spherical();
const vertex = new Vector3();
const pixel = new Vector2();

export class OrbitCamera extends PerspectiveCamera {
	readonly #controls: OrbitControls;
	#fit = 1;
	/** Radius of the framed sphere, and of one body in it. */
	#radius = 1;
	#bodyRadius = 1;
	/** Asked orbit that the framed model does not allow; a crowd that comes later may. */
	#asked: Triple | undefined;
	/** True while the camera is fitted: the orbit stays as it is. */
	#framing = false;
	/** Point that is looked at, by shares of the body's box: 0 its middle, 1 and -1 its sides; for the next `frame`. */
	target: Triple | undefined;
	/** True once a visitor or a link has chosen the orbit. */
	chosen = false;

	/** @param moved called whenever the camera has moved */
	constructor(canvas: HTMLCanvasElement, still: boolean, moved: () => void) {
		super(FIELD_OF_VIEW);
		this.position.z = 1;
		this.#controls = new OrbitControls(this, canvas);
		this.#controls.enablePan = false;
		this.#controls.enableDamping = !still;
		this.#controls.dampingFactor = 0.12;
		this.#controls.addEventListener('start', () => {
			this.chosen = true;
			this.#asked = undefined;
		});
		this.#controls.addEventListener('change', () => {
			this.#fitDepth();
			if (!this.#framing) moved();
		});
		this.dragTurns = false;
	}

	/** True while the left button or one finger turns the camera, not the light. */
	get dragTurns(): boolean {
		return this.#controls.mouseButtons.LEFT === MOUSE.ROTATE;
	}

	set dragTurns(value: boolean) {
		this.#controls.mouseButtons = {
			LEFT: value ? MOUSE.ROTATE : null,
			MIDDLE: MOUSE.DOLLY,
			RIGHT: MOUSE.ROTATE,
		};
		this.#controls.touches = { ONE: value ? TOUCH.ROTATE : null, TWO: TOUCH.DOLLY_ROTATE };
	}

	/** Azimuth and elevation in degrees, distance in units of the one at which the model fits. */
	get orbit(): Triple {
		if (this.#asked) return this.#asked;
		const { theta, phi, radius } = spherical.setFromVector3(offset.subVectors(this.position, this.#controls.target));
		return [MathUtils.radToDeg(theta), 90 - MathUtils.radToDeg(phi), radius / this.#fit];
	}

	set orbit(orbit: Triple) {
		// Set first: listeners to the move read it.
		this.#asked = orbit;
		this.#setOrbit(orbit);
		const { minDistance, maxDistance } = this.#controls;
		const distance = orbit[2] * this.#fit;
		if (distance >= minDistance && distance <= maxDistance) this.#asked = undefined;
	}

	#setOrbit([azimuth, elevation, distance]: Triple): void {
		const phi = MathUtils.degToRad(90 - elevation);
		spherical.set(distance * this.#fit, phi, MathUtils.degToRad(azimuth)).makeSafe();
		this.position.setFromSpherical(spherical).add(this.#controls.target);
		this.#controls.update();
	}

	/**
	 * Fits a model into the middle of a room, keeping angles and relative distance.
	 *
	 * @param width of the picture in CSS pixels
	 * @param room part of the picture
	 */
	frame({ centre, radius, bodyRadius, furLength, model }: Framed, width: number, height: number, room: Room): void {
		const orbit = this.orbit;
		const vertical = Math.tan(MathUtils.degToRad(FIELD_OF_VIEW / 2));
		const narrow = Math.atan(vertical * Math.min(room.width / height, room.height / height));
		this.#fit = framedRadius(radius, furLength) / Math.sin(narrow);
		this.#radius = radius;
		this.#bodyRadius = bodyRadius;
		this.#framing = true;
		this.#shift(width, height, room);
		const { target } = this.#controls;
		target.copy(centre);
		if (model && this.target)
			target.addScaledVector(model.box.getSize(offset).multiply(point.fromArray(this.target)), 0.5);
		const nearest = this.target ? MIN_DISTANCE_ASIDE : MIN_DISTANCE;
		this.#controls.minDistance = (this.#fit * nearest * bodyRadius) / radius;
		this.#controls.maxDistance = this.#fit * MAX_DISTANCE;
		this.orbit = orbit;
		this.#fitDepth();
		this.#framing = false;
	}

	/** Shifts the picture, so that its middle comes to that of the room; the perspective stays. */
	#shift(width: number, height: number, room: Room): void {
		const [right, down] = [room.left + room.width / 2 - width / 2, room.top + room.height / 2 - height / 2];
		this.aspect = width / height;
		if (right === 0 && down === 0) this.clearViewOffset();
		else this.setViewOffset(width, height, -right, -down, width, height);
	}

	/** Box around the vertices of a body on screen: CSS pixels from the picture's left upper corner. @param width of the picture */
	boxOnScreen(body: Object3D, width: number, height: number): Room {
		const box = new Box2();
		this.updateMatrixWorld();
		body.traverse((part) => {
			if (!(part instanceof Mesh)) return;
			for (let i = 0; i < part.geometry.getAttribute('position').count; i++) {
				const { x, y } = part.getVertexPosition(i, vertex).applyMatrix4(part.matrixWorld).project(this);
				box.expandByPoint(pixel.set(((x + 1) / 2) * width, ((1 - y) / 2) * height));
			}
		});
		const { x, y } = box.getSize(pixel);
		return { left: box.min.x, top: box.min.y, width: x, height: y };
	}

	/** Fits near and far plane to the scene, for the sake of depth precision. */
	#fitDepth(): void {
		const distance = this.position.distanceTo(this.#controls.target);
		this.near = Math.max(distance - 4 * this.#radius, this.#bodyRadius / 50);
		this.far = distance + 6 * this.#radius;
		this.updateProjectionMatrix();
	}

	/** Turns by degrees and scales the distance by a factor, for the keyboard. */
	turn(azimuth: number, elevation: number, factor: number): void {
		this.#asked = undefined;
		const [a, e, d] = this.orbit;
		this.chosen = true;
		this.#setOrbit([a + azimuth, MathUtils.clamp(e + elevation, -89.9, 89.9), d * factor]);
	}

	/** Glides to rest; called once per frame. @returns true if the camera has moved */
	glide(): boolean {
		return this.#controls.enableDamping && this.#controls.update();
	}
}
