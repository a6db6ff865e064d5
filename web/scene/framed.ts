/** Room for lamp and fur around a body, in its radii. */
const MARGIN = 1.2;

/**
 * Radius that a picture of a body holds, so that no hair is cut off.
 *
 * @param radius of the body or the crowd
 * @param length of the longest hairs, in the same units
 */
export function framedRadius(radius: number, length: number): number {
	return Math.max(MARGIN * radius, radius + length);
}
