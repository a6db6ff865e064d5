/**
 * Reflections of eyes, noses and the like between hairs: a standard material without a map of its surroundings shines where
 * a lamp is mirrored and nowhere else, so an eye with the lamp behind it is a black ball with a grey rim.
 *
 * The sky of the scene's own lights (ambient, hemisphere, probe) is mirrored, with the horizon as an edge, and less of it where
 * a part is smooth. What would come through the fur around such a part is dark, and a rough part such as a lid's rim has no
 * highlights, as skin below fur has none.
 */

import { type Material, type Mesh, MeshStandardMaterial, type WebGLProgramParametersWithUniforms } from 'three';

/** Height, sine, of the mirrored horizon's middle, and half its width where the part is smooth. */
const HORIZON = { middle: 0.1, width: 0.05 };
/** Share of the sky in what a smooth part mirrors: fur stands around an eye. All of the sky is a grey veil over a black one. */
const SHEEN = 0.3;
/**
 * The brightest of the sky as a window, the glint that keeps an eye alive where no lamp is mirrored: `towards` the viewer from
 * straight above, cosines of its soft edge, brightness over the sky's, and roughness up to which it is seen.
 */
const WINDOW = { towards: 0.9, from: 0.96, to: 0.975, bright: 40, smooth: 0.35 };
/** Cosines between the mirrored direction and the part's front (+z) between which the fur around it lets light through. */
const FUR = { from: -0.6, to: 0.3 };

const VARYING = /* glsl */ `
varying vec3 vFront;`;

// Merged parts of a crowd have no front of their own.
const FRONT = /* glsl */ `
#ifdef USE_INSTANCING
vFront = vec3(0.0);
#else
vFront = normalize(normalMatrix * vec3(0.0, 0.0, 1.0));
#endif`;

const MIRROR = /* glsl */ `
vec3 mirrored = reflect(-geometryViewDir, geometryNormal);
vec3 mirroredLight = ambientLightColor, skyLight = ambientLightColor;
vec3 window = normalize(viewMatrix[1].xyz + ${WINDOW.towards} * geometryViewDir);
float blur = ${HORIZON.width} + material.roughness;
#if defined(USE_LIGHT_PROBES)
mirroredLight += getLightProbeIrradiance(lightProbe, mirrored);
skyLight += getLightProbeIrradiance(lightProbe, window);
#endif
#if NUM_HEMI_LIGHTS > 0
#pragma unroll_loop_start
for (int i = 0; i < NUM_HEMI_LIGHTS; i ++) {
	mirroredLight += mix(hemisphereLights[i].groundColor, hemisphereLights[i].skyColor,
		smoothstep(${HORIZON.middle} - blur, ${HORIZON.middle} + blur, dot(mirrored, hemisphereLights[i].direction)));
	skyLight += hemisphereLights[i].skyColor;
}
#pragma unroll_loop_end
#endif
bool smoothPart = material.roughness <= ${WINDOW.smooth};
if (smoothPart) mirroredLight *= ${SHEEN};
float glint = smoothstep(${WINDOW.from}, ${WINDOW.to}, dot(mirrored, window));
mirroredLight += ${WINDOW.bright.toFixed(1)} * (smoothPart ? glint : 0.0) * skyLight;
float throughFur = dot(vFront, vFront) > 0.5 ? smoothstep(${FUR.from}, ${FUR.to}, dot(mirrored, vFront)) : 1.0;
float shine = throughFur * (1.0 - pow4(material.roughness));
radiance += RECIPROCAL_PI * mirroredLight * shine;
reflectedLight.directSpecular *= shine;
`;

const after = (source: string, chunk: string, more: string) =>
	source.replace(`#include <${chunk}>`, (include) => include + more);

/** A standard material that mirrors the sky. A class, not a hook per material: copies, and merged parts of a herd, keep it. */
export class GleamMaterial extends MeshStandardMaterial {
	override onBeforeCompile(shader: WebGLProgramParametersWithUniforms): void {
		shader.vertexShader = after(shader.vertexShader, 'normal_pars_vertex', VARYING);
		shader.vertexShader = after(shader.vertexShader, 'normal_vertex', FRONT);
		shader.fragmentShader = after(shader.fragmentShader, 'normal_pars_fragment', VARYING);
		shader.fragmentShader = after(shader.fragmentShader, 'lights_fragment_maps', MIRROR);
	}
}

const mirrors = (material: Material | Material[]): material is MeshStandardMaterial =>
	material instanceof MeshStandardMaterial &&
	Object.getPrototypeOf(material) === MeshStandardMaterial.prototype &&
	!material.envMap &&
	!material.flatShading;

/** Lets parts beside skin and fur reflect the sky. @param parts whose front is +z, as those of `--features` */
export function gleam(parts: readonly Mesh[]): void {
	const materials = new Map<MeshStandardMaterial, GleamMaterial>();
	for (const part of parts) {
		const { material } = part;
		if (!mirrors(material)) continue;
		const gleaming = materials.get(material) ?? new GleamMaterial().copy(material);
		materials.set(material, gleaming);
		part.material = gleaming;
	}
}
