/** Three's own materials on bodies in poses of their own. */

import { type Material, MeshDepthMaterial } from 'three';

/**
 * The first joint of a body's pose is in the fourth row of its matrix, which is 0 for all matrices that place bodies; three
 * sees the matrix without it.
 */
const POSED_INSTANCE = /* glsl */ `#include <skinning_pars_vertex>
float firstJoint() { return instanceMatrix[0][3]; }
mat4 placedInstance() {
	mat4 placed = instanceMatrix;
	placed[0][3] = 0.0;
	return placed;
}
#define instanceMatrix placedInstance()`;

/** As three's, in the body's own pose. */
const POSED_JOINTS = /* glsl */ `
mat4 boneMatX = getBoneMatrix(skinIndex.x + firstJoint());
mat4 boneMatY = getBoneMatrix(skinIndex.y + firstJoint());
mat4 boneMatZ = getBoneMatrix(skinIndex.z + firstJoint());
mat4 boneMatW = getBoneMatrix(skinIndex.w + firstJoint());`;

/** Makes a material draw each instance of an InstancedMesh in a pose of its own, beside what its class does to the shader. */
function poseInstances(material: Material): void {
	const before = material.onBeforeCompile;
	const key = material.customProgramCacheKey();
	material.onBeforeCompile = (shader, renderer) => {
		before.call(material, shader, renderer);
		shader.vertexShader = shader.vertexShader
			.replace('#include <skinning_pars_vertex>', POSED_INSTANCE)
			.replace('#include <skinbase_vertex>', POSED_JOINTS);
	};
	material.customProgramCacheKey = () => `${key} posed instances`;
}

/** Copy of a material for bodies in poses of their own. */
export class PosedMaterial {
	readonly material: Material;
	/** Material of the shadows. */
	readonly depth = new MeshDepthMaterial();
	readonly #source: Material;
	#version: number;

	constructor(source: Material) {
		this.#source = source;
		this.#version = source.version;
		this.material = source.clone();
		poseInstances(this.material);
		poseInstances(this.depth);
	}

	/** Copy the source's present colours and switches. */
	follow(): void {
		this.material.copy(this.#source);
		if (this.#version === this.#source.version) return;
		this.#version = this.#source.version;
		this.material.needsUpdate = true;
	}

	dispose(): void {
		this.material.dispose();
		this.depth.dispose();
	}
}
