"""A skeleton for a model that has none: read from a file, its weights found by heat."""
