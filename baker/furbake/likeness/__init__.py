"""How like the truth a furry body is on the page: cells, path-traced truth, the page's pictures, figures, sheets."""
