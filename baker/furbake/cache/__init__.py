"""Finished results that are kept for the next bake, by the hash of all that they depend on."""
