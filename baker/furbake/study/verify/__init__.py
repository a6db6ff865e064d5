"""Bakes beside a path tracer: the flat tile (`tile`), the body on the page (`body`), and its colours (`colour`)."""
