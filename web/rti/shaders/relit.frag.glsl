uniform highp sampler2DArray codes; // four planes a layer, then the colour
uniform vec3 weights[4 * LAYERS]; // what each plane counts for R, G and B, per unit of its texel
uniform vec3 offset; // R, G and B where all texels are 0
varying vec2 vUv;

#include <unmapped>

void main() {
	vec3 seen = offset;
	for (int i = 0; i < LAYERS; i++) {
		vec4 texel = texture(codes, vec3(vUv, float(i)));
		seen += texel.x * weights[4 * i] + texel.y * weights[4 * i + 1];
		seen += texel.z * weights[4 * i + 2] + texel.w * weights[4 * i + 3];
	}
	#ifdef COLOURED
		seen *= texture(codes, vec3(vUv, float(LAYERS))).rgb;
	#endif
	// Photographs are coded as sRGB; the page tone maps and codes light anew.
	gl_FragColor = vec4(unmapped(sRGBTransferEOTF(vec4(clamp(seen, 0.0, 1.0), 1.0)).rgb), 1.0);
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}
