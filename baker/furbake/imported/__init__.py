"""Grooms of artists: curves read from files, bound to a body, as fields over it and as a tile of strands."""
