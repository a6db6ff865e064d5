/**
 * Parts of the shaders, with their code, that only some assets need. Each is a file of its own, fetched beside the first
 * asset that has it and before its materials are made; without it the shaders lack its text, and nothing else.
 */
const FETCHES = {
	/** Several furs on one body. */
	regions: () => import('./regions.ts'),
	/** Joints and morph targets. */
	pose: () => import('./pose.ts'),
	/** Light of format 1.x, which knows one horizon for the whole body. */
	horizon: () => import('./horizon.ts'),
	/** Reading of `scene.environment`, whose part of the shaders is always there; fetched with the first scene that has one. */
	environmentMap: () => import('./environmentMap.ts'),
};

type Parts = { [Name in keyof typeof FETCHES]: Awaited<ReturnType<(typeof FETCHES)[Name]>> };

/** Parts fetched so far. */
export const parts: Partial<Parts> = {};

/** Fetches parts that have not come yet. */
export async function fetchParts(names: readonly (keyof Parts)[]): Promise<void> {
	const fetched = await Promise.all(names.map(async (name) => ({ [name]: await FETCHES[name]() })));
	Object.assign(parts, ...fetched);
}
