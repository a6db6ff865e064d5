// Wet and dirty fur: states of the pelt in the textures, a stack of slabs each, the driest first.

#ifdef WET // number of wet states
uniform float wetnesses[WET]; // wetness of each state, rising
uniform vec4 traits[WET]; // factors of the look: X = length, Y = colour, Z = highlights' strength, W = their exponent

// Place among the states: 1.25 is a quarter of the way from the second to the third.
float placeOf(float wetness) {
	float place = 0.0;
	for (int i = 1; i < WET; i++)
		place += clamp((wetness - wetnesses[i - 1]) / (wetnesses[i] - wetnesses[i - 1]), 0.0, 1.0);
	return place;
}

// State at or below a place; the next one is above.
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
