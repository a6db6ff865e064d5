import { type Intersection, Matrix4, type Mesh, type SkinnedMesh, Triangle, Vector3 } from 'three';

const inverse = new Matrix4();
const point = new Vector3();
const weights = new Vector3();
const corners = [new Vector3(), new Vector3(), new Vector3()] as const;

/** Whether a mesh is moved by joints. */
export function isSkinned(mesh: Mesh): mesh is SkinnedMesh {
	return (mesh as Partial<SkinnedMesh>).isSkinnedMesh === true;
}

/**
 * Place at rest of a point where a ray has met a posed skin: what is painted there stays there.
 *
 * @param hit from `Raycaster`
 * @param target takes the place, world, on the body at rest where its node stands
 */
export function restPoint(hit: Intersection, target: Vector3): Vector3 {
	const mesh = hit.object as Mesh;
	const { face } = hit;
	if (!face || !mesh.isMesh || !(isSkinned(mesh) || mesh.morphTargetInfluences?.some(Boolean)))
		return target.copy(hit.point);
	const [a, b, c] = corners;
	mesh.getVertexPosition(face.a, a);
	mesh.getVertexPosition(face.b, b);
	mesh.getVertexPosition(face.c, c);
	point.copy(hit.point).applyMatrix4(inverse.copy(mesh.matrixWorld).invert());
	if (!Triangle.getBarycoord(point, a, b, c, weights)) return target.copy(hit.point);
	const position = mesh.geometry.getAttribute('position');
	target.set(0, 0, 0);
	target.addScaledVector(a.fromBufferAttribute(position, face.a), weights.x);
	target.addScaledVector(b.fromBufferAttribute(position, face.b), weights.y);
	target.addScaledVector(c.fromBufferAttribute(position, face.c), weights.z);
	return target.applyMatrix4(mesh.matrixWorld);
}
