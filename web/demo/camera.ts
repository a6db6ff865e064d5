/** The camera: turns around the model, comes nearer, and always fits it into the window. */

import { MathUtils, MOUSE, PerspectiveCamera, Spherical, TOUCH, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { Triple } from './address.ts';

const fieldOfView = 26; // degrees, of the window's height
/** Radius of what fits into the window, in radii of the model: leaves room for fur and lamp. */
const margin = 1.2;
const nearest = 0.25; // in units of the distance at which the model fits
const farthest = 4;

const offset = new Vector3();
const spherical = new Spherical();

export class OrbitCamera extends PerspectiveCamera {
	readonly #controls: OrbitControls;
	#fit = 1;
	/** Radii of what is framed, and of one body in it. */
	#radius = 1;
	#closest = 1;
	/** What was asked for where that is nearer or farther than what is framed allows: a crowd may come that does. */
	#asked: Triple | undefined;
	/** True once a visitor or a link has chosen the view. */
	chosen = false;

	/** @param moved called whenever the camera has moved */
	constructor(canvas: HTMLCanvasElement, still: boolean, moved: () => void) {
		super(fieldOfView);
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
			this.#reach();
			moved();
		});
		this.dragTurns = false;
	}

	/** Whether the left button or one finger turns the camera, and not the light. */
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
		// Before it moves, since whoever hears of that looks at it.
		this.#asked = orbit;
		this.#put(orbit);
		const { minDistance, maxDistance } = this.#controls;
		const distance = orbit[2] * this.#fit;
		if (distance >= minDistance && distance <= maxDistance) this.#asked = undefined;
	}

	#put([azimuth, elevation, distance]: Triple): void {
		const phi = MathUtils.degToRad(90 - elevation);
		spherical.set(distance * this.#fit, phi, MathUtils.degToRad(azimuth)).makeSafe();
		this.position.setFromSpherical(spherical).add(this.#controls.target);
		this.#controls.update();
	}

	/**
	 * Aims at a model and fits it into a window, keeping the view as it is: angles and relative distance.
	 *
	 * @param closest radius of one body, where `radius` is that of a crowd
	 */
	frame(centre: Vector3, radius: number, width: number, height: number, closest = radius): void {
		const orbit = this.orbit;
		this.aspect = width / height;
		const vertical = Math.tan(MathUtils.degToRad(fieldOfView / 2));
		const narrow = Math.atan(vertical * Math.min(this.aspect, 1));
		this.#fit = (margin * radius) / Math.sin(narrow);
		this.#radius = radius;
		this.#closest = closest;
		this.#controls.target.copy(centre);
		this.#controls.minDistance = (this.#fit * nearest * closest) / radius;
		this.#controls.maxDistance = this.#fit * farthest;
		this.orbit = orbit;
		this.#reach();
	}

	/** As near and far as there is something to see: what lies between shares one range of depth. */
	#reach(): void {
		const distance = this.position.distanceTo(this.#controls.target);
		this.near = Math.max(distance - 4 * this.#radius, this.#closest / 50);
		this.far = distance + 6 * this.#radius;
		this.updateProjectionMatrix();
	}

	/** Turns and comes nearer, for the keyboard: degrees, degrees, factor. */
	turn(azimuth: number, elevation: number, factor: number): void {
		this.#asked = undefined;
		const [a, e, d] = this.orbit;
		this.chosen = true;
		this.#put([a + azimuth, MathUtils.clamp(e + elevation, -89.9, 89.9), d * factor]);
	}

	/** Once per frame: lets a turn run out. @returns whether the camera has moved */
	glide(): boolean {
		return this.#controls.enableDamping && this.#controls.update();
	}
}
