// Wet and dirty fur: the states of the pelt that the textures hold, a stack of slabs each, from the driest on.

#ifdef WET // how many of them
uniform float wetnesses[WET]; // rising
uniform vec4 traits[WET]; // factors: X = of the hairs' length, Y = of their colour, Z = of the highlights' strength, W = of their exponent

// Place among the states: 1.25 is a quarter of the way from the second to the third.
float placeOf(float wetness) {
	float place = 0.0;
	for (int i = 1; i < WET; i++)
		place += clamp((wetness - wetnesses[i - 1]) / (wetnesses[i] - wetnesses[i - 1]), 0.0, 1.0);
	return place;
}

// The state below a place, of which the next one is above.
int stateBelow(float place) {
	return clamp(int(place), 0, WET - 2);
}

vec4 traitsAt(float place) {
	int below = stateBelow(place);
	return mix(traits[below], traits[below + 1], place - float(below));
}

float wetnessAt(float place) {
	int below = stateBelow(place);
	return mix(wetnesses[below], wetnesses[below + 1], place - float(below));
}
#endif
