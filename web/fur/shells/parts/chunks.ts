/** GLSL chunks shared by several materials. */

import comb from '../../shaders/hair/comb.glsl?raw';
import density from '../../shaders/hair/density.glsl?raw';
import displacement from '../../shaders/hair/displacement.glsl?raw';
import follicle from '../../shaders/hair/follicle.glsl?raw';
import pose from '../../shaders/hair/pose/pose.glsl?raw';
import root from '../../shaders/hair/pose/root.glsl?raw';
import regionIn from '../../shaders/hair/regions/region.frag.glsl?raw';
import region from '../../shaders/hair/regions/region.glsl?raw';
import regionOut from '../../shaders/hair/regions/region.vert.glsl?raw';
import hairShort from '../../shaders/hair/short.glsl?raw';
import trim from '../../shaders/hair/trim.glsl?raw';
import weatherIn from '../../shaders/hair/weather.frag.glsl?raw';
import weather from '../../shaders/hair/weather.glsl?raw';
import weatherOut from '../../shaders/hair/weather.vert.glsl?raw';
import arrival from '../../shaders/light/arrival.glsl?raw';
import bent from '../../shaders/light/bent.glsl?raw';
import curves from '../../shaders/light/curves.glsl?raw';
import environmentMap from '../../shaders/light/environmentMap.glsl?raw';
import eye from '../../shaders/light/eye.glsl?raw';
import glow from '../../shaders/light/glow.glsl?raw';
import lamps from '../../shaders/light/lamps.glsl?raw';
import moments from '../../shaders/light/moments.glsl?raw';
import shadow from '../../shaders/light/shadow.glsl?raw';
import short from '../../shaders/light/short.glsl?raw';
import sky from '../../shaders/light/sky.glsl?raw';
import trimmed from '../../shaders/light/trimmed.glsl?raw';
import view from '../../shaders/light/view.glsl?raw';
import { parts } from './parts.ts';

/** Numbers of the furs on a body. */
const furChunks = (): string[] => [region, parts.regions?.furs ?? '', hairShort];

/** Positions of hairs. */
export const hairChunks = (): string[] => [
	...[...furChunks(), regionOut, root, parts.pose?.morphs ?? '', parts.pose?.joints ?? '', pose],
	...[follicle, comb, weather, weatherOut, trim, displacement],
];

/** Reading of texels. */
export const texelChunks = (): string[] => [...furChunks(), regionIn, trim, density, weather, weatherIn];

/** Arrival of lamps at a point of the fur. @param curved whether by mean curves (format 2.x) */
export const arrivalChunks = (curved: boolean): string[] => [
	...['#include <common>', '#include <lights_pars_begin>', environmentMap],
	...[view, moments, short, trimmed, bent, eye, curved ? curves : (parts.horizon?.horizon ?? ''), arrival],
];

/** Light of lamps. @param curved as above */
export const lampChunks = (curved: boolean): string[] => [...arrivalChunks(curved), shadow, glow, lamps];

/** Light of the environment. */
export const skyChunks = (curved: boolean): string[] => (curved ? [sky] : [parts.horizon?.dip ?? '', sky]);
