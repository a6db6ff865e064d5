"""The picture of the hairs' roots in glTF: written, checked, and read back."""
