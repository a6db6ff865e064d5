/** Pieces of GLSL that several materials begin with. */

import bent from './shaders/bent.glsl?raw';
import body from './shaders/body.glsl?raw';
import comb from './shaders/comb.glsl?raw';
import curves from './shaders/curves.glsl?raw';
import density from './shaders/density.glsl?raw';
import dip from './shaders/dip.glsl?raw';
import displacement from './shaders/displacement.glsl?raw';
import eye from './shaders/eye.glsl?raw';
import follicle from './shaders/follicle.glsl?raw';
import horizon from './shaders/horizon.glsl?raw';
import lamps from './shaders/lamps.glsl?raw';
import moments from './shaders/moments.glsl?raw';
import shadow from './shaders/shadow.glsl?raw';
import sky from './shaders/sky.glsl?raw';
import trim from './shaders/trim.glsl?raw';
import trimmed from './shaders/trimmed.glsl?raw';
import view from './shaders/view.glsl?raw';
import weatherIn from './shaders/weather.frag.glsl?raw';
import weather from './shaders/weather.glsl?raw';
import weatherOut from './shaders/weather.vert.glsl?raw';

/** Where hairs are: of all that draws some. */
export const hairChunks = [body, follicle, comb, weather, weatherOut, trim, displacement];

/** How texels are read: in which state they are. */
export const texelChunks = [trim, density, weather, weatherIn];

/** How lamps light a point of the fur. @param curved by mean curves, as of format 2.x */
export const lampChunks = (curved: boolean): string[] => [
	...['#include <common>', '#include <lights_pars_begin>'],
	...[view, moments, trimmed, bent, eye, curved ? curves : horizon, shadow, lamps],
];

/** How the environment does. */
export const skyChunks = (curved: boolean): string[] => (curved ? [sky] : [dip, sky]);
