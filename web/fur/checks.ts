/** Checks of a model with fur, fetched apart: whoever trusts a model shows it without them. */

import { parseFur } from './format/extension.ts';
import { checkGltf } from './format/gltf.ts';
import { checkRig } from './format/rig.ts';
import { FUR_EXTENSION } from './format.ts';

export { checkGeometry } from './body/checkGeometry.ts';

/**
 * Checks a glTF's JSON before three's loader reads it: of fur of a newer version the glTF alone.
 *
 * @throws Error that names the place, what was got and what is expected
 */
export function checkModel(json: { extensions?: Record<string, object> }): void {
	const extension = json.extensions?.[FUR_EXTENSION] ?? {};
	checkGltf(json);
	checkRig(json, extension);
	parseFur(extension);
}
