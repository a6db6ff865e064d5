"""The command `furbake batch`."""
