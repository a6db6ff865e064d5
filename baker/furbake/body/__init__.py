"""A body to grow fur on: a model read, the direction of its fur, and the fur from place to place."""
