"""The strands of a baked fur on its body, from the baked folder alone: patches, roots, places, files."""
