"""Reflectance transformation imaging: pictures that are relit, in the formats of museums."""
