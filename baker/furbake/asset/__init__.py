"""The files: planes, glTF, the folder they stand in, and whether all of it fits together."""
