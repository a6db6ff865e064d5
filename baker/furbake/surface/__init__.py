"""Meshes and the textured patches that carry their fur; knows no fur physics and no file format of ours."""
