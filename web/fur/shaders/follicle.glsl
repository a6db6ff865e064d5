// The follicle that a vertex stands on: what moves, wets or soils hairs at run time is in textures with a texel for each.

layout(location = 11) in float follicle; // its number

ivec2 follicleTexel() {
	int i = int(follicle);
	return ivec2(i & 255, i >> 8);
}
