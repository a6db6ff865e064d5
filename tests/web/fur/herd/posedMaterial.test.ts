/** Materials of bodies in poses of their own keep the shader of their class. */

import { MeshStandardMaterial, ShaderLib, type WebGLProgramParametersWithUniforms, type WebGLRenderer } from 'three';
import { expect, it } from 'vitest';
import { PosedMaterial } from '../../../../web/fur/herd/posedMaterial.ts';

class Glossy extends MeshStandardMaterial {
	override onBeforeCompile(shader: WebGLProgramParametersWithUniforms): void {
		shader.vertexShader += '// glossy';
	}
}

it('poses instances and keeps what a class of its own does, also after it has followed its source', () => {
	const { vertexShader, fragmentShader } = ShaderLib.physical;
	const of = (material: MeshStandardMaterial) => {
		const posed = new PosedMaterial(material);
		posed.follow();
		const shader = { vertexShader, fragmentShader } as WebGLProgramParametersWithUniforms;
		posed.material.onBeforeCompile(shader, {} as WebGLRenderer);
		return { text: shader.vertexShader, key: posed.material.customProgramCacheKey() };
	};
	const [plain, glossy] = [of(new MeshStandardMaterial()), of(new Glossy())];
	expect(plain.text).toContain('getBoneMatrix(skinIndex.x + firstJoint())');
	expect(glossy.text).toBe(`${plain.text}// glossy`);
	expect(glossy.key).not.toBe(plain.key);
});
