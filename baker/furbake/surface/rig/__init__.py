"""Skeleton, clips and morph targets of a model: read, posed, and carried over to other vertices of the same shape."""
