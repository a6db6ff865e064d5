"""Model files: from glTF and all that trimesh reads to one soup of faces."""
