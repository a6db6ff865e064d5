// Fur that has been cut: the lowest share of it, each slab as thick as it was.

#ifdef TRIMMED
uniform float furTrim; // share of the hairs that is left: s, of the whole hair, goes up to it
#else
#define furTrim 1.0
#endif
