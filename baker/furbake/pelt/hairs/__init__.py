"""Hairs: grown, wetted, soiled, and drawn into voxels."""
