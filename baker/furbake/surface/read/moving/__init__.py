"""Joints, morph targets and clips of a glTF file, which move its parts."""
