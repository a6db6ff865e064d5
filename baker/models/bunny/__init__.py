"""The rabbit of the demo: a mesh of pmndrs' (CC0) with the ears of a rabbit, and the script that writes it."""
