layout(location = 13) in vec4 _fur; // see frame.glsl
layout(location = 14) in vec3 _comb;

void main() {
	takePose();
	feelWeather();
	vec3 point = furPoint(rootPosition, normalize(rootNormal), furComb(_comb), _fur.y, 0.75 * furTrim);
	gl_Position = projectionMatrix * bodyModelView() * vec4(point, 1.0);
}
