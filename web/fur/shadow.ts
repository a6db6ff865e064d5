import { type DirectionalLight, MathUtils, type Sphere } from 'three';

/** Texels along the longest hair, at least: a path tracer's shadows on fur end within a tenth of it. */
const TEXELS = 12;
/** Texels per side. */
const [LEAST, MOST] = [256, 1024];
/** Softness of the edge on what three lights, lengths of the fur. */
const SOFT = 0.25;
/** How far behind the body its shadow still falls, radii. */
const BEHIND = 8;

/**
 * Has a lamp cast the shadow of a furry body, with an edge as sharp as fur shows it: on the fur itself by texels of the map
 * a small share of a hair wide, on skin and ground by three's own filter.
 *
 * It aims the lamp at the body. Call it again when the body, its fur's length or the lamp's distance changes; the lamp may go
 * round it by itself.
 *
 * @param body sphere around it, fur and all, world units
 * @param furLength world units
 */
export function fitShadow(light: DirectionalLight, body: Sphere, furLength: number): void {
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
	const texels = MathUtils.clamp((TEXELS * width) / furLength, LEAST, MOST);
	shadow.mapSize.setScalar(MathUtils.ceilPowerOfTwo(texels));
	shadow.radius = (SOFT * furLength * shadow.mapSize.x) / width;
	// Of what three lights, skin and ground; shells have a distance of their own.
	shadow.normalBias = furLength;
}
