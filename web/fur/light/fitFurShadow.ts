import { type DirectionalLight, MathUtils, type Sphere } from 'three';

/** Fewest texels along the longest hair: path-traced shadow edges on fur are a tenth of it wide. */
const TEXELS = 12;
/** Range of the map's size, texels per side. */
const [MIN_SIZE, MAX_SIZE] = [256, 1024];
/** Softness of the edge on three's own materials, lengths of the fur. */
const SOFT = 0.25;
/** Reach of the shadow behind the body, radii. */
const BEHIND = 8;

/**
 * Makes a lamp cast the shadow of a furry body. On the fur the edge is as sharp as the map's texels, a small share of a
 * hair; on skin and ground three filters it.
 *
 * Aims the lamp at the body. Call it again when the body, its fur's length or the lamp's distance changes; the lamp may
 * turn about the body without that.
 *
 * @param body bounding sphere, fur included, world units
 * @param furLength world units
 * @throws Error for a light that is not directional
 */
export function fitFurShadow(light: DirectionalLight, body: Sphere, furLength: number): void {
	if (!light.isDirectionalLight) throw new Error('fitFurShadow: got another light, expected a DirectionalLight');
	const { shadow } = light;
	const { camera } = shadow;
	light.castShadow = true;
	light.target.position.copy(body.center);
	camera.left = camera.bottom = -body.radius;
	camera.right = camera.top = body.radius;
	const distance = light.position.distanceTo(body.center);
	camera.near = Math.max(distance - body.radius, 0.01 * body.radius);
	camera.far = distance + BEHIND * body.radius;
	camera.updateProjectionMatrix();
	const width = 2 * body.radius;
	const texels = MathUtils.clamp((TEXELS * width) / furLength, MIN_SIZE, MAX_SIZE);
	shadow.mapSize.setScalar(MathUtils.ceilPowerOfTwo(texels));
	shadow.radius = (SOFT * furLength * shadow.mapSize.x) / width;
	// For skin and ground; shells offset by themselves.
	shadow.normalBias = furLength;
}
