import { type Camera, Frustum, Matrix4, Object3D, type OrthographicCamera, Sphere } from 'three';
import type { Fur } from '../Fur.ts';
import { needFur } from '../needFur.ts';
import { BodyDetails } from './BodyDetails.ts';
import { BodyHull, BodyLevel, BodyMaterial } from './BodyLevel.ts';
import { boundAll, cullBodies, cutLevels, type Eye, findEye, levelOf, measurePowers, sortFarFirst } from './bodies.ts';
import { FarSurface, type FurSimplifier } from './FarSurface.ts';
import { HerdPoses, MAX_POSES } from './HerdPoses.ts';
import { HerdSkin } from './HerdSkin.ts';
import { placement } from './pieces.ts';

/** Default number of shells per body of each level. */
const LEVELS = [96, 48, 24, 12, 8] as const;

/** Length over that of the fur when far bodies were simplified, below which they are so anew. */
const SHORTER = 0.7;

const clip = new Matrix4();
const matrix = new Matrix4();
const own = new Matrix4();
const frustum = new Frustum();
const sphere = new Sphere();
const eye: Eye = [0, 0, 0, 1];

/**
 * Many bodies of one furry asset: at most three draws per level of detail in use, however many bodies there are.
 *
 *     const herd = new FurInstances(gltf.userData.fur, 100);
 *     for (let i = 0; i < 100; i++) herd.setMatrixAt(i, matrix.makeTranslation(3 * i, 0, 0));
 *     scene.add(herd);
 *
 * Geometry, textures and uniforms are shared with the fur: settings there show on all bodies, and it has to outlive them.
 * Meshes beside the skin (eyes, say) are included. The fur itself may be hidden, or in no scene. Of several furs of a body,
 * pass the visible one: the skin is copied with its present shade.
 *
 * The renderer calls `update` before it draws, as with three's LOD. Bodies outside the camera's frustum (by the sphere of
 * skin and fur) are culled; the others are sorted into levels by the length of their fur on screen. Opaque pieces are drawn
 * nearest first; then the levels from far to near, each with its fins before its shells, bodies from far to near and the
 * shells of each inside out: fur blends over the fur behind it. The scene sorts all of it as one transparent object in the
 * middle of its bodies. Nothing is uploaded while neither camera nor bodies move.
 */
export class FurInstances extends Object3D {
	/** Poses that bodies with joints can share. */
	static readonly maxPoses = MAX_POSES;
	/** Flag by which the renderer decides to call `update`. */
	readonly isLOD = true;
	/** Whether the renderer calls `update` before every picture. */
	autoUpdate = true;
	/** Largest number of bodies. */
	readonly capacity: number;
	/** Largest number of shells per body of each level, the finest first. */
	readonly levels: readonly number[];
	/** Height of the picture in pixels, for the choice of levels; updated by every draw, so set it before the first. */
	height = 720;
	/** Fewest shells of a body: one for two slabs, where the fur by itself has one for each. */
	fewestShells: number;

	readonly #fur: Fur;
	/** Bounding sphere of one body with its fur, in its own axes. */
	readonly #sphere = new Sphere();
	/** Shells' axes → body's. */
	readonly #furMatrix: Matrix4;
	readonly #skin: HerdSkin;
	/** Poses of a body with joints, and the first joint of each body's. */
	readonly #poses: HerdPoses | undefined;
	readonly #firstJoints: Uint32Array;
	/** Whether `capturePose` has been called. */
	#captured = false;
	readonly #levels: BodyLevel[];
	readonly #finMaterial: BodyMaterial | undefined;
	readonly #hull: BodyHull;
	/** Argument of `simplify`, its surface, and the length of the fur then. */
	#far: { surface: FarSurface; simplifier: FurSimplifier | undefined; length: number } | undefined;
	/** Bounding sphere of all bodies. Shared by all draws, so that the renderer takes them for equally distant. */
	readonly #bounds = new Sphere();

	#count: number;
	#moved = true;
	readonly #matrices: Float32Array;
	readonly #furMatrices: Float32Array;
	readonly #spheres: Float32Array;
	readonly #powers: Float64Array;
	readonly #order: Uint32Array;
	readonly #seen: Uint8Array;
	readonly #details: BodyDetails;
	readonly #level: Uint8Array;
	readonly #drawn: Uint32Array;
	readonly #ends: Uint32Array;

	/**
	 * @param levels largest number of shells per body of each level, falling, whole numbers from 1 to 256
	 * @throws Error for several furs on a body with joints: WebGL2 has no room for so many attributes
	 */
	constructor(fur: Fur, capacity: number, levels: readonly number[] = LEVELS) {
		super();
		needFur('FurInstances', fur);
		this.name = 'fur instances';
		this.#fur = fur;
		this.capacity = this.#count = capacity;
		this.levels = levels;
		this.#matrices = new Float32Array(capacity * 16);
		this.#furMatrices = new Float32Array(capacity * 16);
		this.#spheres = new Float32Array(capacity * 4);
		this.#powers = new Float64Array(capacity);
		this.#order = Uint32Array.from({ length: capacity }, (_, i) => i);
		this.#seen = new Uint8Array(capacity);
		this.#details = new BodyDetails(fur, capacity, levels[0] as number);
		this.#level = new Uint8Array(capacity);
		this.#drawn = new Uint32Array(capacity);
		this.#ends = new Uint32Array(levels.length);

		const { shells, fins, skin } = fur;
		const root = skin.parent ?? skin;
		const { skeleton } = shells;
		if (skeleton && fur.asset.regions)
			throw new Error('FurInstances: got several furs on a body with joints, expected one fur or a body without');
		this.#poses = skeleton && new HerdPoses(skeleton);
		this.#firstJoints = new Uint32Array(capacity);
		this.#furMatrix = placement(shells, root);
		this.fewestShells = fur.asset.layers / 2;
		this.#fit();

		this.#skin = new HerdSkin(root, capacity, this.#bounds, this.#poses, (height) => {
			this.height = height;
		});
		this.#finMaterial = fins && new BodyMaterial(fins.material);
		// Equally distant objects are drawn by age: create the coarsest level first.
		const coarseFirst = levels
			.toReversed()
			.map((count) => new BodyLevel(fur, count, capacity, this.#finMaterial, this.#bounds));
		this.#levels = coarseFirst.toReversed();
		this.add(...this.#skin.meshes);
		for (const { fins, shells } of coarseFirst) this.add(...(fins ? [fins] : []), shells);
		this.#hull = new BodyHull(fur, (coarseFirst[0] as BodyLevel).shells.material, capacity, this.#bounds);
		this.add(this.#hull);
		for (const level of this.#levels) this.#poses && level.carry(this.#poses, this.#furMatrix);
		this.#poses?.carry(this.#hull, this.#furMatrix);

		const home = new Matrix4();
		for (let i = 0; i < capacity; i++) this.setMatrixAt(i, home);
	}

	/** Update to the fur's present length. */
	#fit(): void {
		const { shells, fins } = this.#fur;
		const bounds = (fins ?? shells).geometry.boundingSphere ?? new Sphere();
		this.#sphere.copy(bounds).applyMatrix4(this.#furMatrix);
		if (this.#poses && !this.#poses.sphere.isEmpty()) this.#sphere.copy(this.#poses.sphere);
		this.#details.fit((shells.geometry.boundingSphere?.radius ?? 0) * (this.#sphere.radius / bounds.radius));
	}

	/**
	 * Draws bodies of levels of at most 12 shells, with hairs of 18 pixels, on fewer faces: those of overlapping patches once,
	 * and as few as move their surface by a pixel or so. All bodies cast the shadow of such
	 * faces. It is done anew where the fur has become much shorter.
	 *
	 *     await MeshoptSimplifier.ready; // package meshoptimizer
	 *     herd.simplify(MeshoptSimplifier);
	 *
	 * @param simplifier undefined: only overlaps are left out
	 */
	simplify(simplifier?: FurSimplifier): void {
		const { geometry, furLength: length } = this.#fur.shells;
		const surface = this.#far?.surface ?? new FarSurface(geometry);
		this.#far = { surface, simplifier, length };
		for (const part of [...this.#levels, this.#hull]) part.simplify(surface, simplifier);
	}

	/** Number of bodies drawn, the first of all. */
	override get count(): number {
		return this.#count;
	}

	override set count(value: number) {
		const count = Math.min(Math.max(Math.round(value), 0), this.capacity);
		if (count === this.#count) return;
		this.#count = count;
		// Reset the order, so that it holds exactly the bodies left.
		for (let i = 0; i < this.capacity; i++) this.#order[i] = i;
		this.#moved = true;
	}

	/**
	 * Places a body.
	 *
	 * @param given the body's axes (those of the loaded scene) → these bodies' own; uniform scale
	 */
	setMatrixAt(i: number, given: Matrix4): void {
		given.toArray(this.#matrices, 16 * i);
		matrix.multiplyMatrices(given, this.#furMatrix).toArray(this.#furMatrices, 16 * i);
		const first = this.#firstJoints[i] as number;
		this.#furMatrices[16 * i + 3] = first;
		this.#skin.setMatrixAt(i, given, first);
		this.#place(i, given);
	}

	#refit(): void {
		this.#fit();
		// Bodies with hairs of as many pixels are larger in the picture where hairs are shorter.
		if (this.#far && this.#fur.shells.furLength < SHORTER * this.#far.length) this.simplify(this.#far.simplifier);
		for (let i = 0; i < this.capacity; i++) this.#place(i, this.getMatrixAt(i, matrix));
	}

	#place(i: number, given: Matrix4): void {
		sphere.copy(this.#sphere).applyMatrix4(given);
		sphere.center.toArray(this.#spheres, 4 * i);
		this.#spheres[4 * i + 3] = sphere.radius;
		this.#moved = true;
	}

	/**
	 * Keeps the fur's present pose: of a character, one of up to eight moments that its bodies share. Until the first call all
	 * bodies stand in the fur's present pose.
	 *
	 *     for (let pose = 0; pose < 8; pose++) {
	 *     	mixer.setTime(seconds + (pose / 8) * clip.duration);
	 *     	herd.capturePose(pose);
	 *     }
	 *
	 * Morph targets have no poses of their own: all bodies show the fur's present ones.
	 *
	 * @param pose 0 to 7
	 */
	capturePose(pose: number): void {
		this.#captured = true;
		this.#capture(pose);
	}

	#capture(pose: number): void {
		const { skin, material } = this.#fur;
		if (!(this.#poses || 'MORPHS' in material.defines) || !(pose >= 0 && pose < MAX_POSES)) return;
		this.#fur.bounds(sphere);
		matrix.copy((skin.parent ?? skin).matrixWorld).invert();
		if (!this.#poses || this.#poses.capture(pose, matrix, sphere)) this.#refit();
	}

	/** Puts a body into one of the poses kept by `capturePose`; at first all are in pose 0. */
	setPoseAt(i: number, pose: number): void {
		this.#firstJoints[i] = this.#poses?.first(pose) ?? 0;
		this.setMatrixAt(i, this.getMatrixAt(i, own));
	}

	/** Matrix last given to `setMatrixAt`. */
	getMatrixAt(i: number, target: Matrix4): Matrix4 {
		return target.fromArray(this.#matrices, 16 * i);
	}

	/** Number of shells of body `i` by the last `update`; may be fractional. */
	getShellsAt(i: number): number {
		return this.#details.shells(i);
	}

	/** Culls, sorts and picks levels for the next draw by this camera. World matrices have to be up to date. */
	update(camera: Camera): void {
		const count = this.#count;
		if (!this.#captured) this.#capture(0);
		if (!this.#details.fits) this.#refit();
		if (this.#moved) boundAll(this.#spheres, count, this.#bounds);
		matrix.multiplyMatrices(camera.matrixWorldInverse, this.matrixWorld);
		clip.multiplyMatrices(camera.projectionMatrix, matrix);
		const { coordinateSystem, reversedDepth } = camera as OrthographicCamera;
		frustum.setFromProjectionMatrix(clip, coordinateSystem, reversedDepth);
		cullBodies(this.#spheres, count, frustum.planes, this.#seen);

		const scale = this.matrixWorld.getMaxScaleOnAxis();
		findEye(camera, matrix.invert(), eye);
		measurePowers(this.#spheres, count, eye, this.#powers);
		sortFarFirst(this.#order, count, this.#powers);

		for (let i = 0; i < count; i++) {
			const radius = this.#spheres[4 * i + 3] as number;
			const away = eye[3] ? scale * Math.sqrt((this.#powers[i] as number) + radius * radius) : 1;
			this.#details.put(i, (scale * radius) / this.#sphere.radius, away, this.fewestShells, camera, this.height);
			this.#level[i] = levelOf(this.#details.shells(i), this.levels);
		}
		cutLevels(this.#order, count, this.#seen, this.#level, this.#drawn, this.#ends);

		const total = this.#ends[0] ?? 0;
		this.#skin.put(this.#drawn, total, this.#moved);
		for (let l = 0; l < this.#levels.length; l++) {
			const first = this.#ends[l + 1] ?? 0;
			const bodies = (this.#ends[l] as number) - first;
			this.#levels[l]?.put(this.#drawn, first, bodies, this.#furMatrices, this.#details, this.#moved);
		}
		this.#finMaterial?.follow();
		this.#hull.putAll(count, this.#furMatrices, this.#moved);
		this.#moved = false;
	}

	/** Frees everything but the fur. */
	override dispose(): void {
		this.removeFromParent();
		this.#skin.dispose();
		this.#poses?.dispose();
		for (const level of this.#levels) level.dispose();
		this.#hull.dispose();
		this.#finMaterial?.dispose();
	}
}
