// Light of scene.environment, in scenes without light probes.
#if defined(ENVIRONMENT_MAP) && !defined(USE_LIGHT_PROBES)
#define USE_LIGHT_PROBES
#define lightProbe environmentProbe
uniform vec3 environmentProbe[9];
#endif
