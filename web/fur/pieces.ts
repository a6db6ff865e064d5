/** The meshes of one body below its fur (skin, eyes, nose): as few draws as there can be. */

import {
	BufferAttribute,
	BufferGeometry,
	DataTexture,
	DoubleSide,
	FloatType,
	Matrix3,
	Matrix4,
	type Mesh,
	type MeshStandardMaterial,
	type Object3D,
	Texture,
	Vector3,
} from 'three';

/** What is drawn of a body in one go. */
export interface Piece {
	geometry: BufferGeometry;
	material: Mesh['material'];
	/** The geometry's axes → the body's. */
	matrix: Matrix4;
	/** The mesh that this stands for, or the first of them. */
	mesh: Mesh;
	/** Frees what was made for this piece, not what belongs to the mesh. */
	dispose(): void;
}

const KNOWN = new Set(['position', 'normal', 'tangent', 'color', 'uv']);

/** Whether all there is to the mesh is colour, roughness and metalness: what vertices can bring. */
function isPlain({ material, geometry, customDepthMaterial }: Mesh): boolean {
	if (Array.isArray(material) || material.type !== 'MeshStandardMaterial' || customDepthMaterial) return false;
	const { emissive, transparent, alphaTest, flatShading, wireframe } = material as MeshStandardMaterial;
	if (transparent || alphaTest > 0 || flatShading || wireframe || emissive.getHex() !== 0) return false;
	if (Object.hasOwn(material, 'onBeforeCompile')) return false;
	if (Object.values(material).some((value) => value instanceof Texture)) return false;
	return Object.keys(geometry.attributes).every((name) => KNOWN.has(name));
}

/**
 * Closed meshes without pictures become one, each vertex with the colour, roughness and metalness of its own; others stay
 * as they are.
 *
 * @param placement the body's axes, from those of a mesh
 */
export function gatherPieces(meshes: readonly Mesh[], placement: (mesh: Mesh) => Matrix4): Piece[] {
	const plain = meshes.filter(isPlain);
	const merged = plain.length > 1 ? [merge(plain, placement)] : [];
	const alone = merged.length ? meshes.filter((mesh) => !plain.includes(mesh)) : meshes;
	return [
		...merged,
		...alone.map((mesh) => ({
			mesh,
			geometry: mesh.geometry,
			material: mesh.material,
			matrix: placement(mesh),
			dispose() {},
		})),
	];
}

/** In the axes of the first, whose vertices keep their places to the bit. */
function merge(meshes: readonly Mesh[], placement: (mesh: Mesh) => Matrix4): Piece {
	const [mesh] = meshes as [Mesh];
	const matrix = placement(mesh);
	const total = meshes.reduce((sum, { geometry }) => sum + geometry.getAttribute('position').count, 0);
	const positions = new Float32Array(total * 3);
	const normals = new Float32Array(total * 3);
	const colours = new Float32Array(total * 3);
	const coordinates = new Float32Array(total * 2);
	const surfaces = new Float32Array(meshes.length * 4);
	const corners: number[] = [];
	const inverse = matrix.clone().invert();
	const vector = new Vector3();
	let vertex = 0;
	for (const [m, piece] of meshes.entries()) {
		const { color, roughness, metalness, vertexColors } = piece.material as MeshStandardMaterial;
		surfaces.set([0, roughness, metalness, 1], m * 4);
		const between = m === 0 ? new Matrix4() : new Matrix4().multiplyMatrices(inverse, placement(piece));
		const turn = new Matrix3().getNormalMatrix(between);
		const { index } = piece.geometry;
		const [position, normal] = [piece.geometry.getAttribute('position'), piece.geometry.getAttribute('normal')];
		const own = vertexColors ? piece.geometry.getAttribute('color') : undefined;
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
			for (const [c, value] of color.toArray().entries())
				colours[vertex * 3 + c] = value * (own?.getComponent(i, c) ?? 1);
		}
	}
	const geometry = new BufferGeometry();
	geometry.setAttribute('position', new BufferAttribute(positions, 3));
	geometry.setAttribute('normal', new BufferAttribute(normals, 3));
	geometry.setAttribute('color', new BufferAttribute(colours, 3));
	geometry.setAttribute('uv', new BufferAttribute(coordinates, 2));
	geometry.setIndex(corners);

	const material = (mesh.material as MeshStandardMaterial).clone();
	const palette = new DataTexture(surfaces, meshes.length, 1, undefined, FloatType);
	palette.needsUpdate = true;
	material.color.set(1, 1, 1);
	material.vertexColors = true;
	material.roughnessMap = material.metalnessMap = palette;
	material.roughness = material.metalness = 1;
	if (meshes.some((piece) => (piece.material as MeshStandardMaterial).side === DoubleSide)) material.side = DoubleSide;
	return {
		mesh,
		geometry,
		material,
		matrix,
		dispose() {
			geometry.dispose();
			material.dispose();
			palette.dispose();
		},
	};
}

/** The part's axes → those of `root`, in which it stands. */
export function placement(part: Object3D, root: Object3D): Matrix4 {
	const total = new Matrix4();
	for (let at: Object3D | null = part; at && at !== root; at = at.parent) {
		at.updateMatrix();
		total.premultiply(at.matrix);
	}
	return total;
}
