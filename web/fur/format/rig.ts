/** Check of joints, morph targets and clips in a glTF's JSON: three's loader trusts them, or drops them without a word. */

/** Accessor, as far as it is checked here. */
interface Accessor {
	count: number;
	type: string;
	componentType: number;
	normalized?: boolean;
}

type Attributes = Record<string, number>;

interface Primitive {
	attributes: Attributes;
	targets?: Attributes[];
}

interface Channel {
	sampler: number;
	target: { node?: number; path: string };
}

interface Gltf {
	nodes?: { mesh?: number; skin?: number }[];
	meshes?: { primitives: Primitive[]; weights?: number[] }[];
	skins?: { joints: number[]; inverseBindMatrices?: number }[];
	accessors?: Accessor[];
	animations?: { channels: Channel[]; samplers: { input: number; output: number; interpolation?: string }[] }[];
}

/** Nodes of a fur. */
interface Parts {
	skin?: number;
	shells?: number;
	fins?: number;
}

/** Type of the values of a path, and whether a morph target each. */
const PATHS: Record<string, string> = { translation: 'VEC3', rotation: 'VEC4', scale: 'VEC3', weights: 'SCALAR' };
const UNSIGNED_BYTE = 5121;
const UNSIGNED_SHORT = 5123;
const FLOAT = 5126;

function refuse(where: string, got: string, expected: string): never {
	throw new Error(`glTF/${where}: got ${got}, expected ${expected}`);
}

/**
 * Checks what moves a model, once the lists themselves are known to be sound.
 *
 * @param parts the extension's object: its parts have to be moved by the same joints and targets
 * @throws Error that names the place, what was got and what is expected
 */
export function checkRig(json: object, parts: Parts): void {
	const gltf = json as Gltf;
	for (const [i, skin] of (gltf.skins ?? []).entries()) checkSkin(gltf, skin, `skins/${i}`);
	for (const [i, mesh] of (gltf.meshes ?? []).entries()) checkTargets(gltf, mesh, `meshes/${i}`);
	gltf.nodes?.forEach(({ mesh, skin }, i) => {
		if (skin === undefined || mesh === undefined) return;
		for (const [p, { attributes }] of gltf.meshes?.[mesh]?.primitives.entries() ?? [])
			checkVertices(gltf, attributes, `nodes/${i} with a skin, meshes/${mesh}/primitives/${p}`);
	});
	gltf.animations?.forEach(({ channels, samplers }, i) => {
		for (const [c, channel] of channels.entries()) {
			const sampler = samplers[channel.sampler];
			const where = `animations/${i}/channels/${c}`;
			if (!sampler) refuse(where, `sampler ${channel.sampler}`, `less than ${samplers.length}`);
			checkKeys(gltf, channel, sampler, where);
		}
	});
	checkParts(gltf, parts);
}

function checkSkin({ accessors = [] }: Gltf, skin: NonNullable<Gltf['skins']>[0], where: string): void {
	if (skin.joints.length === 0) refuse(where, 'no joints', 'at least one');
	const inverse = accessors[skin.inverseBindMatrices as number];
	if (!inverse) return;
	const { type, componentType, count } = inverse;
	if (type !== 'MAT4' || componentType !== FLOAT || count < skin.joints.length)
		refuse(`${where}/inverseBindMatrices`, `${count} ${type}`, `${skin.joints.length} MAT4 of floats`);
}

function checkVertices({ accessors = [] }: Gltf, attributes: Attributes, where: string): void {
	const { count } = accessors[attributes.POSITION as number] ?? { count: 0 };
	for (const [name, types] of [
		['JOINTS_0', [UNSIGNED_BYTE, UNSIGNED_SHORT]],
		['WEIGHTS_0', [UNSIGNED_BYTE, UNSIGNED_SHORT, FLOAT]],
	] as const) {
		const accessor = accessors[attributes[name] as number];
		if (!accessor) refuse(where, `no ${name}`, 'joints and weights of every vertex');
		if (accessor.type !== 'VEC4' || accessor.count !== count)
			refuse(`${where}/${name}`, `${accessor.count} ${accessor.type}`, `${count} VEC4`);
		if (!(types as readonly number[]).includes(accessor.componentType))
			refuse(`${where}/${name}`, `components of type ${accessor.componentType}`, `one of ${types.join(', ')}`);
	}
}

function checkTargets({ accessors = [] }: Gltf, mesh: NonNullable<Gltf['meshes']>[0], where: string): void {
	const wanted = mesh.primitives[0]?.targets?.length ?? 0;
	const { weights } = mesh;
	if (weights && weights.length !== wanted)
		refuse(`${where}/weights`, `${weights.length}`, `${wanted}, one per morph target`);
	for (const [p, { attributes, targets = [] }] of mesh.primitives.entries()) {
		const here = `${where}/primitives/${p}/targets`;
		if (targets.length !== wanted) refuse(here, `${targets.length}`, `${wanted} as of the first primitive`);
		const { count } = accessors[attributes.POSITION as number] ?? { count: 0 };
		const names = Object.keys(targets[0] ?? {});
		for (const [t, target] of targets.entries()) {
			// Where a target has none three takes the vertices' own values for changes.
			if (Object.keys(target).sort().join() !== [...names].sort().join() || !('POSITION' in target))
				refuse(`${here}/${t}`, Object.keys(target).join(', '), 'POSITION, and the attributes of the first target');
			for (const [name, index] of Object.entries(target)) {
				const accessor = accessors[index];
				if (accessor?.count !== count || accessor.type !== 'VEC3')
					refuse(`${here}/${t}/${name}`, `${accessor?.count} ${accessor?.type}`, `${count} VEC3`);
			}
		}
	}
}

function checkKeys(
	{ accessors = [], nodes = [], meshes = [] }: Gltf,
	{ target: { node, path } }: Channel,
	{ input, output, interpolation }: { input: number; output: number; interpolation?: string },
	where: string,
): void {
	const type = PATHS[path];
	// Three leaves out unknown paths.
	if (!type || node === undefined) return;
	const [times, values] = [accessors[input], accessors[output]];
	if (times?.type !== 'SCALAR') refuse(`${where}/times`, `${times?.type}`, 'SCALAR');
	if (values?.type !== type) refuse(`${where}/values`, `${values?.type}`, `${type} for ${path}`);
	const each = path === 'weights' ? (meshes[nodes[node]?.mesh as number]?.primitives[0]?.targets?.length ?? 0) : 1;
	const wanted = times.count * each * (interpolation === 'CUBICSPLINE' ? 3 : 1);
	if (values.count !== wanted) refuse(`${where}/values`, `${values.count}`, `${wanted} for ${times.count} keys`);
}

/** Checks that shells and fins are moved by what moves the skin. */
function checkParts({ nodes = [], meshes = [] }: Gltf, { skin, shells, fins }: Parts): void {
	const body = nodes[skin as number];
	if (!body) return;
	const targetsOf = (mesh: number | undefined) => meshes[mesh as number]?.primitives[0]?.targets?.length ?? 0;
	for (const [role, index] of Object.entries({ shells, fins })) {
		const part = nodes[index as number];
		if (!part) continue;
		if (part.skin !== body.skin)
			refuse(`nodes/${index}, the ${role}`, `skin ${part.skin ?? 'none'}`, `${body.skin ?? 'none'} as of the body`);
		const [got, wanted] = [targetsOf(part.mesh), targetsOf(body.mesh)];
		if (got !== wanted) refuse(`nodes/${index}, the ${role}`, `${got} morph targets`, `${wanted} as of the body`);
	}
}
