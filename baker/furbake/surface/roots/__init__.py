"""The model's own colours at the roots of its hairs: one picture, laid out by the shells' texture coordinates."""
