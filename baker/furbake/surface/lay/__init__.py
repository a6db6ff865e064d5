"""Direction of the fur, and the textured patches along it."""
