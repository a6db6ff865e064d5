// Fur of a vertex, and its share there.

#ifdef REGIONS
int furRegion = 0;
float furSecond = 0.0; // 1 in the fur after the coat
#define furTiles (tiles / furWidth)
#else
#define furTiles tiles
#endif
#if defined(REGIONS) || defined(ONE_FUR)
in vec3 _region; // XY = bounds of the numbers of this fur's hairs, 0..1; Z = number of the fur, over 255
#endif
#ifdef ONE_FUR // one of the furs all over the body
#define FUR_SHARE (_region.y - _region.x)
#else
#define FUR_SHARE 1.0
#endif

// Reads the fur; call it before all other functions of the hairs.
void takeFur() {
#ifdef PARTED
	furRegion = int(_region.z * 255.0 + 0.5);
	furSecond = step(0.5 / 255.0, _region.z);
#endif
}
