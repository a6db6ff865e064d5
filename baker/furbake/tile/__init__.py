"""A tile of fur: from options to pelts; knows no mesh."""
