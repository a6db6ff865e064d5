layout(location = 12) in vec4 color; // colour of the skin, linear
layout(location = 13) in vec4 _fur; // X = angle from the edge to where the fur is laid, over 2π; YZW as in frame.glsl
layout(location = 15) in vec4 _edge; // XY = angles of the two faces' normals about the edge, over π; ZW = comb along the edge and across it

#ifdef ROOTS
layout(location = 14) in vec2 uv1; // place of the root in the picture of the roots
uniform vec2 rootsUnit; // coordinates of that picture per tile
out vec2 vRoot;
#define baseColour (vSkin.rgb * color.rgb)
#else
#define baseColour vSkin.rgb
#endif

uniform float tiles; // texture coordinates → tiles
uniform float finHeights; // second texture coordinate → heights
uniform float finLength; // length of the fin, lengths of the fur here

out vec2 vAt; // tiles along the edge, height
centroid out vec4 vSkin; // RGB = factor of the hairs' colour, A = mix of tip and tip2
centroid out float vFade; // opacity of the fin, and 2 more for each fur before its own

// Cosines between the viewer and the two faces' normals. upright, across: axes about the edge from which their angles count.
vec2 facesTowards(vec3 viewer, vec3 upright, vec3 across) {
	vec2 angle = PI * _edge.xy;
#ifdef USE_SKINNING
	return vec2(
		dot(posedNormal(cos(angle.x) * upright + sin(angle.x) * across), viewer),
		dot(posedNormal(cos(angle.y) * upright + sin(angle.y) * across), viewer)
	);
#else
	return cos(angle) * dot(upright, viewer) + sin(angle) * dot(across, viewer);
#endif
}

// Opacity of a fin: full at the silhouette, where one face looks to the viewer and the other away; less where both look the
// same way; 0 where they look straight, and where the fin is seen from its end.
float finFade(vec2 facing, float broadside) {
	vec2 towards = abs(facing);
	float off = facing.x * facing.y > 0.0 ? min(towards.x, towards.y) : 0.0;
	return (1.0 - smoothstep(FADE_FROM, FADE_TO, off)) * smoothstep(0.15, 0.5, abs(broadside));
}

void main() {
	takePose();
	feelWeather();
	vec3 n = normalize(rootNormal);
	vec3 edge = normalize(rootTangent);
	vec3 across = normalize(cross(edge, n));
	vec3 upright = cross(across, edge);
	mat3 frame = mat3(cross(n, across), n, across);
	mat4 placement = bodyModelView();
	mat3 turn = mat3(placement) / length(placement[0].xyz);

	vec3 viewer = viewerVS((placement * vec4(rootPosition, 1.0)).xyz) * turn;
#ifdef USE_SKINNING
	vec3 restEdge = normalize(restTangent);
	vec3 restAcross = normalize(cross(restEdge, restNormal));
	float fade = finFade(facesTowards(viewer, normalize(cross(restAcross, restEdge)), restAcross), dot(across, viewer));
#else
	float fade = finFade(facesTowards(viewer, upright, across), dot(across, viewer));
#endif

	vAt = uv * vec2(furTiles, finHeights * furTrim);
	// An invisible quad collapses to its root and has no fragments.
	float s = fade > 0.0 ? min(vAt.y, furTrim) : 0.0;
	vec3 comb = finComb(frame * vec3(_edge.z, 0.0, _edge.w));
	vec3 bend = furCurvature(_fur.y);
	vFade = fade * divergence(bend, comb, s) + 2.0 * float(furRegion);
	vec3 pointVS = (placement * vec4(furPoint(rootPosition, n, comb, _fur.y * finLength, s), 1.0)).xyz;
	gl_Position = projectionMatrix * vec4(pointVS, 1.0);
#ifdef ROOTS
	vSkin = vec4(skinColor, tipShare * _fur.w);
	vec2 slope;
	vRoot = uv1 - rootsUnit * furWidth * driftAt(s, slope);
#else
	vSkin = vec4(skinColor * color.rgb, tipShare * _fur.w);
#endif
#ifdef WET
	vSkin.rgb *= furTraits.y;
#endif
	float slab = clamp(s * float(LAYERS) - 0.5, 0.0, float(LAYERS) - 1.0);
	// Light comes to hairs that lean as the fur is laid, whichever way the edge runs.
	float angle = PI2 * _fur.x;
	mat2 laid = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
	mat2x3 level = mat2x3(frame[0], across) * laid;
	frame = mat3(level[0], n, level[1]);
	mat2 curved = transpose(laid) * mat2(bend.x, bend.z, bend.z, bend.y) * laid;
	bend = vec3(curved[0].x, curved[1].y, curved[0].y);
	passLight(fade > 0.0, FurPoint(turn * frame, comb * frame, pointVS, furReach(_fur.y), hairShare(_fur.y), s, slab, bend), _fur.z);
}
