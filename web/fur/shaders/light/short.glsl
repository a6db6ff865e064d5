// Light on hairs that are shorter here than the pelt's: pressed flat, they show more of their sides to it, and look from aside
// as the pelt does from nearer above. By the law of pelt/short.py.

// Way through the pelt that meets the hairs which this one meets. ts: in the axes of lightTS
vec3 throughPelt(FurPoint point, vec3 ts) {
	ts.UP /= point.share;
	return normalize(ts);
}

// Factor of all light.
float shortGain(FurPoint point) {
#ifdef FIN
	return 1.0; // the law is that of what is seen from above
#else
	float s = point.s / furTrim;
	vec3 growth = ofFur(shorts, 1, 0).xyz;
	return 1.0 - log(point.share) * (growth.x + s * (growth.y + s * growth.z));
#endif
}
