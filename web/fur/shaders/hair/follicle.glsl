// Follicle of a vertex: motion, wetness and dirt are in textures with a texel per follicle.

layout(location = 11) in float follicle; // number of the follicle

ivec2 follicleTexel() {
	int i = int(follicle);
	return ivec2(i & 255, i >> 8);
}
