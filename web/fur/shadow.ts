import type { DirectionalLight, Sphere } from 'three';

/** Texels per side: a fur's shadow has no detail finer than its hairs are long. */
const MAP_SIZE = 256;

/**
 * Has a lamp cast the shadow of a furry body, as soft as its fur is long: hairs of half that length cast it and the tips
 * catch it, so that neither knows the other's edge, and the end of the light is no knife.
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
	camera.far = distance + body.radius;
	camera.updateProjectionMatrix();
	shadow.mapSize.setScalar(MAP_SIZE);
	shadow.radius = (furLength * MAP_SIZE) / (2 * body.radius);
	// Of what three lights, skin and ground; shells have a distance of their own.
	shadow.normalBias = furLength;
}
