"""Pictures and pages of a bake: swatch, report, and data of the lesson."""
