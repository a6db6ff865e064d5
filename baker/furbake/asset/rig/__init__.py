"""What moves a body, as glTF stores it: skin, joints, morph targets, animations."""
