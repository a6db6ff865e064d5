/** Camera that orbits a body. */

import { MathUtils, PerspectiveCamera, Vector3 } from 'three';
import { framedRadius } from '../scene/framed.ts';
import { clampCamera, type Triple } from './attributes.ts';

/** Degrees, of the picture's height. */
const FIELD_OF_VIEW = 26;

export class OrbitCamera extends PerspectiveCamera {
	readonly #centre = new Vector3();
	#radius = 1;
	#length = 0;
	#orbit: Triple = [0, 0, 1];

	constructor() {
		super(FIELD_OF_VIEW);
	}

	/** Azimuth and elevation in degrees, distance in units of the one at which the body fits. */
	get orbit(): Triple {
		return this.#orbit;
	}

	set orbit(orbit: Triple) {
		this.#orbit = clampCamera(orbit);
		this.#place();
	}

	/** Fits a body into a picture. @param length of its longest hairs; @param aspect of the picture, width over height */
	frame(centre: Vector3, radius: number, length: number, aspect: number): void {
		this.#centre.copy(centre);
		this.#radius = radius;
		this.#length = length;
		this.aspect = aspect;
		this.#place();
	}

	#place(): void {
		const [azimuth, elevation, distance] = this.#orbit;
		const half = Math.tan(MathUtils.degToRad(FIELD_OF_VIEW / 2)) * Math.min(1, this.aspect);
		const away = (distance * framedRadius(this.#radius, this.#length)) / Math.sin(Math.atan(half));
		this.position
			.setFromSphericalCoords(away, MathUtils.degToRad(90 - elevation), MathUtils.degToRad(azimuth))
			.add(this.#centre);
		this.lookAt(this.#centre);
		this.near = Math.max(away - 4 * this.#radius, this.#radius / 50);
		this.far = away + 6 * this.#radius;
		this.updateProjectionMatrix();
		this.updateMatrixWorld();
	}
}
