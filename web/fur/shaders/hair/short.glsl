// Hairs that are shorter here than the pelt's: see pelt/short.py.

#define SHORTEST 0.0625 // share of the length below which light no longer changes

uniform vec4 shorts[FURS]; // numbers of each fur: XYZ = growth of its light by 1, s, s²; W = 1 over the length of the pelt's hairs, the mesh's own units
