"""Light through voxels of hair."""
