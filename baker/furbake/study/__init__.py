"""Studies: how good a bake is against path tracing, and against fur baked anew."""
