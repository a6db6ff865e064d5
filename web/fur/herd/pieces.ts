/** Meshes of one body below its fur (skin, eyes, nose), merged into few draws. */

import {
	BufferAttribute,
	BufferGeometry,
	Color,
	DataTexture,
	DoubleSide,
	FloatType,
	type InterleavedBufferAttribute,
	Matrix3,
	Matrix4,
	type Mesh,
	MeshStandardMaterial,
	type Object3D,
	Texture,
	Vector3,
} from 'three';
import { MatteMaterial } from '../body/skin/MatteMaterial.ts';
import { isKeptThin, markThin } from '../body/skin/thin.ts';

/** One draw of a body. */
export interface Piece {
	geometry: BufferGeometry;
	material: Mesh['material'];
	/** The geometry's axes → the body's. */
	matrix: Matrix4;
	/** The mesh, or the first of several merged ones. */
	mesh: Mesh;
	/** Whether parts of it are thin, by `markThin`. */
	thin: boolean;
	/** Update to its meshes' present colours: skin is darker below wet fur. */
	follow(): void;
	/** Frees this piece but not the mesh. */
	dispose(): void;
}

const KNOWN = new Set([
	'position',
	'normal',
	'tangent',
	'color',
	'uv',
	'skinIndex',
	'skinWeight',
	'spine',
	'spineRoot',
]);

/** Classes that a merged piece need not keep: one of an application's own, such as a glossy eye's, takes their place. */
const COMMON = new Set<unknown>([MeshStandardMaterial, MatteMaterial]);

/** Whether vertices can carry all of the material: colour, roughness and metalness. */
function isPlain({ material, geometry, customDepthMaterial }: Mesh): boolean {
	if (Array.isArray(material) || material.type !== 'MeshStandardMaterial' || customDepthMaterial) return false;
	const { emissive, transparent, alphaTest, flatShading, wireframe } = material as MeshStandardMaterial;
	if (transparent || alphaTest > 0 || flatShading || wireframe || emissive.getHex() !== 0) return false;
	if (Object.hasOwn(material, 'onBeforeCompile') && !isKeptThin(material)) return false;
	if (Object.values(material).some((value) => value instanceof Texture)) return false;
	if (Object.keys(geometry.morphAttributes).length > 0) return false;
	return Object.keys(geometry.attributes).every((name) => KNOWN.has(name));
}

/**
 * Merges closed meshes without textures into one, with colour, roughness and metalness per vertex; others stay as they are,
 * and those that joints move apart from those that they do not.
 *
 * @param placement a mesh's axes → the body's
 */
export function gatherPieces(meshes: readonly Mesh[], placement: (mesh: Mesh) => Matrix4): Piece[] {
	const plain = meshes.filter(isPlain);
	const groups = [true, false].map((moved) =>
		plain.filter((mesh) => mesh.geometry.hasAttribute('skinIndex') === moved),
	);
	const shared = groups.filter((group) => group.length > 1);
	const merged = shared.map((group) => {
		const piece = merge(group, placement);
		return { ...piece, thin: markThin(piece.geometry, group) };
	});
	const alone = meshes.filter((mesh) => !shared.some((group) => group.includes(mesh)));
	return [
		...merged,
		...alone.map((mesh) => ({
			mesh,
			geometry: mesh.geometry,
			material: mesh.material,
			matrix: placement(mesh),
			thin: false,
			follow() {},
			dispose() {},
		})),
	];
}

type Attribute = BufferAttribute | InterleavedBufferAttribute;

const versionOf = (attribute: Attribute | undefined) =>
	attribute && ('data' in attribute ? attribute.data.version : attribute.version);

/** Colours of one mesh within a merged piece. */
class Part {
	readonly #mesh: Mesh;
	readonly #first: number;
	/** Colour when last copied. */
	readonly #shade = new Color(Number.NaN, 0, 0);
	#own: Attribute | undefined;
	#version: number | undefined;

	/** @param first its first vertex in the piece */
	constructor(mesh: Mesh, first: number) {
		this.#mesh = mesh;
		this.#first = first;
	}

	/** Copy the colours if they have changed. */
	copy(colours: BufferAttribute): void {
		const { geometry, material } = this.#mesh;
		const { color, vertexColors } = material as MeshStandardMaterial;
		const own = vertexColors ? geometry.getAttribute('color') : undefined;
		if (this.#shade.equals(color) && this.#own === own && this.#version === versionOf(own)) return;
		this.#shade.copy(color);
		this.#own = own;
		this.#version = versionOf(own);
		const { r, g, b } = color;
		const end = this.#first + geometry.getAttribute('position').count;
		for (let v = this.#first, i = 0; v < end; v++, i++)
			if (own) colours.setXYZ(v, r * own.getX(i), g * own.getY(i), b * own.getZ(i));
			else colours.setXYZ(v, r, g, b);
		colours.needsUpdate = true;
	}
}

/** Merge in the axes of the first mesh, whose vertices keep their positions to the bit. */
function merge(meshes: readonly Mesh[], placement: (mesh: Mesh) => Matrix4): Omit<Piece, 'thin'> {
	const [mesh] = meshes as [Mesh];
	const matrix = placement(mesh);
	const total = meshes.reduce((sum, { geometry }) => sum + geometry.getAttribute('position').count, 0);
	const positions = new Float32Array(total * 3);
	const normals = new Float32Array(total * 3);
	const colours = new BufferAttribute(new Float32Array(total * 3), 3);
	const parts: Part[] = [];
	const coordinates = new Float32Array(total * 2);
	const corners: number[] = [];
	const inverse = matrix.clone().invert();
	const vector = new Vector3();
	let vertex = 0;
	for (const [m, piece] of meshes.entries()) {
		const between = m === 0 ? new Matrix4() : new Matrix4().multiplyMatrices(inverse, placement(piece));
		const turn = new Matrix3().getNormalMatrix(between);
		const { index } = piece.geometry;
		const [position, normal] = [piece.geometry.getAttribute('position'), piece.geometry.getAttribute('normal')];
		parts.push(new Part(piece, vertex));
		const count = index?.count ?? position.count;
		for (let i = 0; i < count; i++) corners.push(vertex + (index?.getX(i) ?? i));
		for (let i = 0; i < position.count; i++, vertex++) {
			vector
				.fromBufferAttribute(position, i)
				.applyMatrix4(between)
				.toArray(positions, vertex * 3);
			vector
				.fromBufferAttribute(normal, i)
				.applyNormalMatrix(turn)
				.toArray(normals, vertex * 3);
			coordinates.set([(m + 0.5) / meshes.length, 0.5], vertex * 2);
		}
	}
	const geometry = new BufferGeometry();
	for (const name of ['skinIndex', 'skinWeight'])
		if (mesh.geometry.hasAttribute(name)) geometry.setAttribute(name, joined(meshes, name, total));
	geometry.setAttribute('position', new BufferAttribute(positions, 3));
	geometry.setAttribute('normal', new BufferAttribute(normals, 3));
	geometry.setAttribute('color', colours);
	geometry.setAttribute('uv', new BufferAttribute(coordinates, 2));
	geometry.setIndex(corners);

	const { material, palette } = sharedMaterial(meshes.map((piece) => piece.material as MeshStandardMaterial));
	const follow = () => {
		for (const part of parts) part.copy(colours);
	};
	follow();
	return {
		mesh,
		geometry,
		material,
		matrix,
		follow,
		dispose() {
			geometry.dispose();
			material.dispose();
			palette.dispose();
		},
	};
}

/** Four numbers per vertex of all meshes, one after the other. */
function joined(meshes: readonly Mesh[], name: string, total: number): BufferAttribute {
	const values = new Float32Array(4 * total);
	let at = 0;
	for (const { geometry } of meshes) {
		const attribute = geometry.getAttribute(name);
		for (let i = 0; i < attribute.count; i++) for (let c = 0; c < 4; c++) values[at++] = attribute.getComponent(i, c);
	}
	return new BufferAttribute(values, 4);
}

/**
 * The first material for all of them, in the class of one that is not `COMMON`, if any: colours come by vertex, roughness and
 * metalness by a palette of a texel each.
 */
function sharedMaterial(materials: readonly MeshStandardMaterial[]): {
	material: MeshStandardMaterial;
	palette: DataTexture;
} {
	const texels = materials.flatMap(({ roughness, metalness }) => [0, roughness, metalness, 1]);
	const palette = new DataTexture(new Float32Array(texels), materials.length, 1, undefined, FloatType);
	palette.needsUpdate = true;
	const [first] = materials as [MeshStandardMaterial];
	const special = materials.find((one) => !COMMON.has(one.constructor));
	const material = (special ?? first).clone().copy(first);
	material.color.set(1, 1, 1);
	material.vertexColors = true;
	material.roughnessMap = material.metalnessMap = palette;
	material.roughness = material.metalness = 1;
	if (materials.some(({ side }) => side === DoubleSide)) material.side = DoubleSide;
	return { material, palette };
}

/** Matrix from a part's axes to those of its ancestor `root`. */
export function placement(part: Object3D, root: Object3D): Matrix4 {
	const total = new Matrix4();
	for (let at: Object3D | null = part; at && at !== root; at = at.parent) {
		at.updateMatrix();
		total.premultiply(at.matrix);
	}
	return total;
}
