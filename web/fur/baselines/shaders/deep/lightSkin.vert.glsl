#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>

void main() {
	#include <skinbase_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	gl_Position = projectionMatrix * modelViewMatrix * vec4(transformed, 1.0);
}
