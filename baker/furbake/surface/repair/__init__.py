"""Faces of any soup made a manifold surface, and simpler copies of it."""
