/** A limb of two bones with clips, made in the tests. */

import {
	AnimationClip,
	Bone,
	BufferAttribute,
	CylinderGeometry,
	Float32BufferAttribute,
	Group,
	NumberKeyframeTrack,
	Quaternion,
	QuaternionKeyframeTrack,
	Skeleton,
	SkinnedMesh,
	Vector3,
	VectorKeyframeTrack,
} from 'three';

const turn = (angle: number) => new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), angle).toArray();

/** Upright, 2 high and 0.4 wide, its upper half on a second bone; a target makes it 1 wider to the right. */
export function limb() {
	const geometry = new CylinderGeometry(0.2, 0.2, 2, 12, 20).translate(0, 1, 0);
	const position = geometry.getAttribute('position');
	const shares = Array.from({ length: position.count }, (_, i) => Math.min(Math.max(position.getY(i) - 0.5, 0), 1));
	const joints = new Uint8Array(shares.flatMap(() => [0, 1, 0, 0]));
	geometry.setAttribute('skinIndex', new BufferAttribute(joints, 4));
	const weights = shares.flatMap((share) => [1 - share, share, 0, 0]);
	geometry.setAttribute('skinWeight', new Float32BufferAttribute(weights, 4));
	const wider = Array.from({ length: position.count }, (_, i) => [position.getX(i) > 0 ? 1 : 0, 0, 0]).flat();
	geometry.morphAttributes.position = [new Float32BufferAttribute(wider, 3)];
	geometry.morphTargetsRelative = true;
	const mesh = new SkinnedMesh(geometry);
	mesh.name = 'limb';
	mesh.updateMorphTargets();
	const [root, elbow] = [new Bone(), new Bone()];
	root.name = 'root';
	elbow.name = 'elbow';
	elbow.position.y = 1;
	const object = new Group().add(mesh, root.add(elbow));
	// The pose in which the skin hangs on its bones.
	object.updateMatrixWorld(true);
	mesh.bind(new Skeleton([root, elbow]));
	const clips = [
		new AnimationClip('Bend', -1, [
			new QuaternionKeyframeTrack('elbow.quaternion', [0, 1, 2], [...turn(0), ...turn(Math.PI / 2), ...turn(0)]),
		]),
		new AnimationClip('Leap', -1, [new VectorKeyframeTrack('root.position', [0, 0.5, 1], [0, 0, 0, 0, 3, 0, 0, 0, 0])]),
		new AnimationClip('Swell', -1, [new NumberKeyframeTrack('limb.morphTargetInfluences[0]', [0, 1], [0, 1])]),
	];
	return { object, mesh, root, elbow, clips };
}
