import { MeshStandardMaterial, type WebGLProgramParametersWithUniforms } from 'three';
import matte from '../../shaders/skin/matte.glsl?raw';

/**
 * A standard material whose highlights of lamps end with its smoothness. Three's have some left at a roughness of 1, pale specks
 * at grazing angles where dark skin shows between hairs. A class, not a hook per material: copies, and merged parts of a herd,
 * keep it.
 */
export class MatteMaterial extends MeshStandardMaterial {
	override onBeforeCompile(shader: WebGLProgramParametersWithUniforms): void {
		shader.fragmentShader = shader.fragmentShader.replace(
			'#include <lights_fragment_end>',
			(include) => `${include}\n${matte}`,
		);
	}

	/** A copy of a material below fur: matte where it is a plain standard one. */
	static of(material: MeshStandardMaterial): MeshStandardMaterial {
		const plain =
			Object.getPrototypeOf(material) === MeshStandardMaterial.prototype && !Object.hasOwn(material, 'onBeforeCompile');
		return plain ? new MatteMaterial().copy(material) : material.clone();
	}
}
