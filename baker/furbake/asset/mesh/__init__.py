"""Vertices and faces as glTF stores them."""
