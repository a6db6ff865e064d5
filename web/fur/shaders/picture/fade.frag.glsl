// Picture that fades out, linear and premultiplied; its share is the blending's constant.
uniform sampler2D picture;

in vec2 place;

layout(location = 0) out vec4 colour;

void main() {
	colour = texture(picture, place);
#ifdef TONE_MAPPING
	colour.rgb = toneMapping(colour.rgb);
#endif
	colour = linearToOutputTexel(colour);
}
