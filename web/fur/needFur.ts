/**
 * Stops where a fur is missing, as of a model that has none.
 *
 * @param user what the fur is given to
 * @throws Error
 */
export function needFur(user: string, fur: object | null | undefined): void {
	if (!fur) throw new Error(`${user}: got ${fur}, expected a fur, gltf.userData.fur of a model that has one`);
}
