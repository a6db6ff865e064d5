"""Samples of light to coefficients, and these to bytes."""
