"""Several furs on one body: their vertices, images and numbers in an asset."""
